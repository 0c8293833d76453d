#pragma once

#include <atomic>

namespace sdf_ccd {

/// Thrown out of work that is no longer wanted. It is no std::exception: who takes those for the failure of one body
/// lets it pass.
struct Cancelled {};

/// While it lives, work on this thread ends with Cancelled soon after the flag has been set, by whatever thread.
///
/// The flag belongs to the thread, so that what lies between the caller and a long loop need not hand it on. Scopes
/// nest: the inner one counts.
class CancelScope {
 public:
  /// @param asked  must outlive the scope.
  explicit CancelScope(const std::atomic<bool>& asked);
  ~CancelScope();
  CancelScope(const CancelScope&) = delete;
  CancelScope& operator=(const CancelScope&) = delete;

 private:
  const std::atomic<bool>* outer_;
};

/// The flag of the thread that makes it, also for the tasks that this thread hands to others. Long work makes one and
/// checks it every few milliseconds: a check costs as much as reading a variable.
class CancelPoint {
 public:
  CancelPoint();

  bool asked() const { return asked_ && asked_->load(std::memory_order_relaxed); }

  /// @throws Cancelled if it has been asked for.
  void check() const {
    if (asked()) throw Cancelled();
  }

 private:
  const std::atomic<bool>* asked_;
};

/// Checks the flag of this thread. @throws Cancelled.
inline void checkCancelled() {
  CancelPoint().check();
}

}  // namespace sdf_ccd
