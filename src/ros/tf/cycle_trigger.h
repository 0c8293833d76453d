#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace sdf_ccd {

/// Event that triggers a cycle.
enum class TriggerKind {
  kTimer,        ///< the timer
  kTf,           ///< any moving transform
  kJointStates,  ///< a message of joint states
  kFrames,       ///< a group of frames: when each of them has received a transform since the last cycle
};

struct TriggerOptions {
  TriggerKind kind = TriggerKind::kTimer;
  std::vector<std::string> frames;  ///< the group of kFrames, without leading slashes
  double period = 1.0;              ///< between two cycles, see dueAfter(); of the timer [s]
  double patience = 0.1;            ///< longest wait for an event; then a cycle begins without one [s]
};

/// The first of the times begin + k × period (k > 0) that is later than `now`. A cycle that begins late does not delay
/// the following ones; missed cycles are skipped.
std::chrono::nanoseconds nextOnGrid(std::chrono::nanoseconds begin, std::chrono::nanoseconds now,
                                    std::chrono::nanoseconds period);

/// Earliest time at which an event may trigger the next cycle, if the last one could begin at `due` and began at
/// `begun`. Events that arrive once per period, some of them up to half a period late, thus trigger one cycle each, and
/// a late one does not delay those after it. Successive cycles are at least half a period apart; a cycle and the n-th
/// one after it, at least n - 1/2 periods.
std::chrono::nanoseconds dueAfter(std::chrono::nanoseconds due, std::chrono::nanoseconds begun,
                                  std::chrono::nanoseconds period);

/// Decides when the next cycle is due. One thread waits; any thread may report events.
class CycleTrigger {
 public:
  /// May be called while a thread waits; the cycle that it waits for is then due within one new period.
  void setOptions(const TriggerOptions& options);

  /// Report an event: a transform of this frame (without leading slashes), any moving transforms, joint states.
  void onFrame(const std::string& child);
  void onTransforms() { onEvent(TriggerKind::kTf); }
  void onJointStates() { onEvent(TriggerKind::kJointStates); }

  /// Whether onFrame() has to be called.
  bool wantsFrames() const;

  /// The first frame of the group of which no transform has arrived so far: cycles then begin only after `patience`.
  /// Empty if all have arrived, or none is waited for.
  std::string awaitedFrame() const;

  /// Blocks until the next cycle is due. @return false, at once, after stop().
  /// @param woken  called by the waiting thread, once for one or several calls of wake().
  bool wait(const std::function<void()>& woken = {});

  /// Requests a call of `woken` between two cycles; at once if a thread waits.
  void wake();

  /// Blocks for this time [s], whatever events arrive. @return false, at once, after stop().
  bool waitFor(double seconds);

  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  static std::chrono::nanoseconds now();
  std::chrono::nanoseconds period() const;
  void onEvent(TriggerKind kind);
  void clearEvents();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  TriggerOptions options_;
  std::vector<char> has_arrived_;  // per frame of the group: a transform has arrived since the last cycle
  std::size_t awaited_ = 0;
  std::vector<char> has_ever_arrived_;  // the same, since the options were set
  bool has_event_ = false;
  bool stop_ = false;
  bool woken_ = false;
  std::chrono::nanoseconds due_{0};  // on the steady clock; 0 before the first cycle
};

}  // namespace sdf_ccd
