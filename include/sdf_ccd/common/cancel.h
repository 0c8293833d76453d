#pragma once

#include <atomic>
#include <chrono>

namespace sdf_ccd {

/// Thrown to end work that is no longer needed. It is no std::exception, so that handlers of errors of one body
/// do not catch it.
struct Cancelled {};

/// The conditions that end a thread's work: a flag, null if there is none, and a time.
struct CancelRequest {
  using Clock = std::chrono::steady_clock;

  const std::atomic<bool>* asked = nullptr;
  Clock::time_point deadline = Clock::time_point::max();
};

/// The request of the thread that makes it, also for the tasks that this thread hands to others. Long work makes one
/// and checks it every few milliseconds: a check costs as much as reading a variable and, where there is a deadline,
/// the clock (25 ns), so that loops of cheap steps do it every so many (CancelTicks).
class CancelPoint {
 public:
  CancelPoint();

  bool asked() const {
    if (request_.asked && request_.asked->load(std::memory_order_relaxed)) return true;
    constexpr auto kNever = CancelRequest::Clock::time_point::max();
    return request_.deadline != kNever && CancelRequest::Clock::now() >= request_.deadline;
  }

  /// @throws Cancelled if it has been requested.
  void check() const {
    if (asked()) throw Cancelled();
  }

  const CancelRequest& request() const { return request_; }

 private:
  CancelRequest request_;
};

/// While it lives, work on this thread ends with Cancelled soon after the flag has been set, by whatever thread, or
/// after the deadline.
///
/// The request belongs to the thread, so that what lies between the caller and a long loop need not hand it on. Scopes
/// nest: the inner flag counts, and the earlier deadline.
class CancelScope {
 public:
  /// @param asked  must outlive the scope.
  explicit CancelScope(const std::atomic<bool>& asked);
  explicit CancelScope(CancelRequest::Clock::time_point deadline);

  /// For a task of another thread: what ends that one's work ends this one's, and nothing else.
  explicit CancelScope(const CancelPoint& point);

  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  CancelRequest outer_;
};

/// Checks this thread's request. @throws Cancelled.
inline void checkCancelled() {
  CancelPoint().check();
}

/// A CancelPoint for a loop of steps that take less than microseconds: looks at it every `Period` of them.
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
