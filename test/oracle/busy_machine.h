#pragma once

#include <stdlib.h>

#include <algorithm>
#include <thread>

namespace sdf_ccd::test {

/// Factor by which a time limit must be longer than on an idle machine, because other processes use the processors too;
/// 1 if the load does not exceed the number of processors.
inline double slowness() {
  double load = 0.0;
  if (::getloadavg(&load, 1) != 1) return 1.0;
  const double processors = std::max(1U, std::thread::hardware_concurrency());
  return std::max(1.0, 2.0 * load / processors - 1.0);
}

}  // namespace sdf_ccd::test
