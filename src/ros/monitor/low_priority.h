#pragma once

#include <sys/resource.h>

namespace sdf_ccd {

/// Lets cycles, which have a niceness of 0, run before this thread from now on.
inline void lowerPriority() {
  constexpr int kNiceness = 5;
  thread_local bool is_low = false;
  if (!is_low) setpriority(PRIO_PROCESS, 0, kNiceness);  // of this thread alone, on Linux
  is_low = true;
}

}  // namespace sdf_ccd
