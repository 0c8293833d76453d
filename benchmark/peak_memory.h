#pragma once

#include <cstddef>
#include <fstream>
#include <functional>
#include <string>

namespace sdf_ccd::benchmark {

/// Peak memory of a piece of work beyond that of the process before, from Linux's high-water mark [bytes]. Pages that
/// the allocator keeps from earlier work are not counted. 0 if /proc does not report it.
inline std::size_t peakMemory(const std::function<void()>& work) {
  const auto kilobytes = [](const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
      if (line.compare(0, key.size(), key) == 0) return std::stoul(line.substr(key.size()));
    }
    return 0UL;
  };
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush;  // resets the high-water mark
  const std::size_t before = kilobytes("VmRSS:");
  work();
  const std::size_t after = kilobytes("VmHWM:");
  return after > before ? (after - before) << 10 : 0;
}

}  // namespace sdf_ccd::benchmark
