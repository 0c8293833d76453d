#pragma once

#include <chrono>

namespace sdf_ccd {

/// Wall clock [s].
inline double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace sdf_ccd
