#include "mesh/import/read_limits.h"

#include <unistd.h>

#include <algorithm>

namespace sdf_ccd {
namespace {

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20;
constexpr std::uint64_t kMin = 512 * kMiB;
constexpr double kCpuSeconds = 5.0, kCpuSecondsPerMiB = 1.0;
constexpr double kWallPerCpu = 6.0;  // allows for other load and for swapping

std::uint64_t computersMemory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
  return pages > 0 && bytes > 0 ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(bytes) : 4096 * kMiB;
}

}  // namespace

ReadLimits limitsOf(const std::string& format, std::uint64_t bytes) {
  ReadLimits limits;
  limits.memory = format == "octomap" ? std::min(kMin + 2000 * bytes, 6144 * kMiB) : kMin + 32 * bytes;
  limits.memory = std::min(limits.memory, std::max(kMin, computersMemory() / 4 * 3));
  limits.cpu_seconds = kCpuSeconds + kCpuSecondsPerMiB * static_cast<double>(bytes) / static_cast<double>(kMiB);
  limits.wall_seconds = kWallPerCpu * limits.cpu_seconds;
  return limits;
}

}  // namespace sdf_ccd
