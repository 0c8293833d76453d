#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include <tbb/task_arena.h>

namespace sdf_ccd {

/// Threads of low priority for work in parallel to the cycles, one piece of it at a time.
///
/// TBB's own threads serve all arenas of the process, the cycles' too, and a thread without privileges that has lowered
/// its priority cannot raise it again. So none of them enters this arena: it has threads of its own.
class WorkArena {
 public:
  /// With half of the processors, so that the cycles have the others.
  WorkArena();

  /// @param threads  that work at a time, the calling one among them: 1 or more.
  explicit WorkArena(int threads);
  ~WorkArena();
  WorkArena(const WorkArena&) = delete;
  WorkArena& operator=(const WorkArena&) = delete;

  std::size_t threads() const { return threads_; }

  /// Does the work in the calling thread, whose priority should be low, and its parallel loops on all of the arena's
  /// threads. Waits for earlier work. A CancelScope of the calling thread ends both. The work must not call this.
  /// @throws Cancelled, and what the work throws.
  void run(const std::function<void()>& work);

 private:
  struct Stay;
  class Working;

  void help();
  bool enter(Stay& stay);

  const std::size_t threads_;
  tbb::task_arena arena_;
  std::timed_mutex turn_;             // of the work that runs; guards helpers_
  std::vector<std::thread> helpers_;  // started with the first work
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_working_ = false, is_stopping_ = false;  // guarded by mutex_
  std::vector<Stay*> stays_;                       // of the helpers that are in the arena; guarded by mutex_
};

}  // namespace sdf_ccd
