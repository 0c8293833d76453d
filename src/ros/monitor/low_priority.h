#pragma once

#include <sys/resource.h>

namespace sdf_ccd {

/// Lets cycles, which have a nice value of 0, run before this thread from now on.
inline void lowerPriority() {
  constexpr int kNiceness = 5;
  thread_local bool is_low = false;
  if (!is_low) setpriority(PRIO_PROCESS, 0, kNiceness);  // on Linux: of this thread only
  is_low = true;
}

}  // namespace sdf_ccd
