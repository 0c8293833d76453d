#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

namespace sdf_ccd {

/// What begins a cycle.
enum class TriggerKind {
  kTimer,        ///< the rate
  kTf,           ///< any moving transform
  kJointStates,  ///< joint states
  kFrames,       ///< the last of a group of frames: when all of them have come since the last cycle
};

struct TriggerOptions {
  TriggerKind kind = TriggerKind::kTimer;
  std::vector<std::string> frames;  ///< of kFrames, without leading slashes
  double period = 1.0;              ///< between two cycles, see dueAfter(); a timer's [s]
  double patience = 0.1;            ///< without news a cycle begins all the same after so long [s]
};

/// The first of the times begin + k × period (k > 0) that is later than now: what began too late does not shift those
/// that come after it, and what was missed is left out.
std::chrono::nanoseconds nextOnGrid(std::chrono::nanoseconds begin, std::chrono::nanoseconds now,
                                    std::chrono::nanoseconds period);

/// From when on news may begin the next cycle, after one that might have begun at `due` and has at `begun`. News that
/// come once a period, some of them late by up to half of it, thus begin a cycle each: the late ones do not shift those
/// that come after them. From a cycle to the next it is half a period at least, to the n-th after it n - 1/2 periods.
std::chrono::nanoseconds dueAfter(std::chrono::nanoseconds due, std::chrono::nanoseconds begun,
                                  std::chrono::nanoseconds period);

/// Says when the next cycle is due. One thread waits; any may bring news.
class CycleTrigger {
 public:
  /// Also while a thread waits, whose cycle is due no later than the new period tells.
  void setOptions(const TriggerOptions& options);

  /// News: transforms of these frames, without leading slashes; joint states.
  void onFrame(const std::string& child);
  void onTransforms() { bring(TriggerKind::kTf); }
  void onJointStates() { bring(TriggerKind::kJointStates); }

  /// Whether it needs the names of frames.
  bool wantsFrames() const;

  /// The first frame of the group of which no transform has come so far: cycles then begin after `patience` only. Empty
  /// if all have come, or none is waited for.
  std::string awaitedFrame() const;

  /// Until the next cycle is due. @return false, and at once, after stop().
  /// @param woken  called, by the thread that waits, for each wake() or several.
  bool wait(const std::function<void()>& woken = {});

  /// Something is to be done between two cycles, at once if one waits.
  void wake();

  /// Until so much time has passed [s], whatever comes. @return false, and at once, after stop().
  bool waitFor(double seconds);

  void stop();

 private:
  using Clock = std::chrono::steady_clock;

  static std::chrono::nanoseconds now();
  std::chrono::nanoseconds period() const;
  void bring(TriggerKind kind);
  void takeNews();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  TriggerOptions options_;
  std::vector<char> has_come_;  // per frame of the group, since the last cycle
  std::size_t to_come_ = 0;
  std::vector<char> has_ever_come_;  // the same, since the options were set
  bool news_ = false;
  bool stop_ = false;
  bool woken_ = false;
  std::chrono::nanoseconds due_{0};  // on the steady clock; 0 before the first cycle
};

}  // namespace sdf_ccd
