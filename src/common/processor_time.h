#pragma once

#include <ctime>

namespace sdf_ccd {

/// Processor's time that the calling thread has taken [s]: what other work on the machine does not count in.
inline double threadSeconds() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

}  // namespace sdf_ccd
