#pragma once

#include <sys/resource.h>

namespace sdf_ccd {

/// Lowers the priority of the calling thread below that of cycles, which have a nice value of 0. Without privileges it
/// cannot be raised again, and threads that it starts inherit it: TBB's, too, so that parallel loops of such a thread
/// must run in a WorkArena.
inline void lowerPriority() {
  constexpr int kNiceness = 5;
  thread_local bool is_low = false;
  if (!is_low) setpriority(PRIO_PROCESS, 0, kNiceness);  // on Linux: of this thread only
  is_low = true;
}

}  // namespace sdf_ccd
