#pragma once

#include <ctime>

namespace sdf_ccd {

/// Processor time of the calling thread [s]: other work on the machine is not included.
inline double threadSeconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace sdf_ccd
