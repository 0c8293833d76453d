#pragma once

#include <unistd.h>

#include <algorithm>
#include <cstddef>

namespace sdf_ccd {

/// The largest field that can be built in this machine's memory, which takes up to twice as much [bytes].
/// @param used  by other fields [bytes].
inline std::size_t machineLimit(std::size_t used = 0) {
  const std::size_t all = std::size_t(sysconf(_SC_PHYS_PAGES)) * std::size_t(sysconf(_SC_PAGESIZE));
  return (all - std::min(all, used)) / 2;
}

}  // namespace sdf_ccd
