#pragma once

#include <atomic>
#include <chrono>

#include "sdf_ccd/cancel.h"

namespace sdf_ccd {

/// The conditions that end a thread's work: a flag, null if there is none, and a time.
struct CancelRequest {
  /// Of deadlines: never set back.
  using Clock = std::chrono::steady_clock;

  const std::atomic<bool>* requested = nullptr;
  Clock::time_point deadline = Clock::time_point::max();
};

/// The cancel request of the thread that constructs it; tasks on other threads may use it, too. Long work constructs
/// one and checks it every few milliseconds. A check reads a variable and, if there is a deadline, the clock (25 ns),
/// so loops of cheap steps check only every so many steps (CancelTicks).
class CancelPoint {
 public:
  CancelPoint();

  /// Whether the work is to end: the flag is set, or the deadline has passed.
  bool requested() const {
    if (request_.requested && request_.requested->load(std::memory_order_relaxed)) return true;
    constexpr auto kNever = CancelRequest::Clock::time_point::max();
    return request_.deadline != kNever && CancelRequest::Clock::now() >= request_.deadline;
  }

  /// @throws Cancelled if it has been requested.
  void check() const {
    if (requested()) throw Cancelled();
  }

  /// What ends this work.
  const CancelRequest& request() const { return request_; }

 private:
  CancelRequest request_;
};

/// For a task on another thread: exactly what cancels the work at `point` cancels the task.
class TaskCancelScope {
 public:
  explicit TaskCancelScope(const CancelPoint& point);
  ~TaskCancelScope();
  TaskCancelScope(const TaskCancelScope&) = delete;
  TaskCancelScope& operator=(const TaskCancelScope&) = delete;

 private:
  CancelRequest outer_;
};

/// Checks this thread's request. @throws Cancelled.
inline void checkCancelled() {
  CancelPoint().check();
}

/// A CancelPoint for loops whose steps take less than a microsecond: checks it once every `Period` steps.
template <unsigned Period = 64>
class CancelTicks {
 public:
  /// @throws Cancelled if it has been requested.
  void check() {
    if (++steps_ % Period == 0) point_.check();
  }

 private:
  CancelPoint point_;
  unsigned steps_ = 0;
};

}  // namespace sdf_ccd
