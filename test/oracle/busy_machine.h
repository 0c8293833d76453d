#pragma once

#include <stdlib.h>

#include <algorithm>
#include <thread>

namespace sdf_ccd::test {

/// How many times longer than on a quiet machine what is limited by the clock may take here, as others use its
/// processors too: 1 if there are no more of them than processors.
inline double slowness() {
  double load = 0.0;
  if (::getloadavg(&load, 1) != 1) return 1.0;
  const double processors = std::max(1U, std::thread::hardware_concurrency());
  return std::max(1.0, 2.0 * load / processors - 1.0);
}

}  // namespace sdf_ccd::test
