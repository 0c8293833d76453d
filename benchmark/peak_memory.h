#pragma once

#include <cstddef>
#include <fstream>
#include <functional>
#include <string>

namespace sdf_ccd::benchmark {

/// Memory that a piece of work needs at its worst beyond what the process held before, from Linux's high-water mark
/// [bytes]; pages that the allocator keeps from earlier work are not counted. 0 where /proc does not tell.
inline std::size_t peakMemory(const std::function<void()>& work) {
  const auto kilobytes = [](const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
      if (line.compare(0, key.size(), key) == 0) return std::stoul(line.substr(key.size()));
    }
    return 0UL;
  };
  std::ofstream("/proc/self/clear_refs") << "5" << std::flush;  // starts the high-water mark anew
  const std::size_t before = kilobytes("VmRSS:");
  work();
  const std::size_t after = kilobytes("VmHWM:");
  return after > before ? (after - before) << 10 : 0;
}

}  // namespace sdf_ccd::benchmark
