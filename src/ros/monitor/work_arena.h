#pragma once

#include <algorithm>
#include <thread>

#include <tbb/task_arena.h>

#include "sdf_ccd/common/cancel.h"

namespace sdf_ccd {

/// Half of the processors, for work in parallel to the cycles, which have the others.
class WorkArena {
 public:
  /// Does the work there. A CancelScope of the calling thread ends it.
  template <class Work>
  void run(const Work& work) {
    const CancelPoint cancel;
    arena_.execute([&] {
      const CancelScope scope(cancel);  // this may run in another thread
      work();
    });
  }

 private:
  tbb::task_arena arena_{std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2)};
};

}  // namespace sdf_ccd
