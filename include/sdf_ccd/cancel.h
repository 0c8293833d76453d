#pragma once

#include <atomic>
#include <chrono>

namespace sdf_ccd {

/// Thrown to end work that is no longer needed. It is no std::exception, so that handlers of errors of one body
/// do not catch it.
struct Cancelled {};

/// While it exists, work on this thread ends with Cancelled soon after the flag has been set, by any thread, or after
/// the deadline.
///
/// The request belongs to the thread, so functions between the caller and a long loop need not pass it on. Scopes nest:
/// the inner flag replaces the outer one, and the earlier deadline counts.
class CancelScope {
 public:
  /// Of deadlines: never set back.
  using Clock = std::chrono::steady_clock;

  /// @param requested  must outlive the scope.
  explicit CancelScope(const std::atomic<bool>& requested);
  /// The flag of an outer scope stays.
  explicit CancelScope(Clock::time_point deadline);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  const std::atomic<bool>* outer_flag_;
  Clock::time_point outer_deadline_;
};

}  // namespace sdf_ccd
