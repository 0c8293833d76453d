#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace sdf_ccd {

/// Reports a cycle that does not end: its own thread cannot while it runs.
class CycleWatchdog {
 public:
  using Seconds = std::chrono::duration<double>;

  /// @param limit   a cycle that takes longer is reported, and again whenever as long has passed.
  /// @param report  called on the watchdog's thread with how long the cycle has taken so far; must not throw.
  CycleWatchdog(Seconds limit, std::function<void(Seconds)> report);
  ~CycleWatchdog();
  CycleWatchdog(const CycleWatchdog&) = delete;
  CycleWatchdog& operator=(const CycleWatchdog&) = delete;

  /// A cycle, while it lives. After it has ended, no report of it begins, and none is under way.
  class Cycle {
   public:
    explicit Cycle(CycleWatchdog& watchdog) : watchdog_(watchdog) { watchdog_.begin(); }
    ~Cycle() { watchdog_.end(); }
    Cycle(const Cycle&) = delete;
    Cycle& operator=(const Cycle&) = delete;

   private:
    CycleWatchdog& watchdog_;
  };

 private:
  using Clock = std::chrono::steady_clock;

  void begin();
  void end();
  void run();

  const Seconds limit_;
  const std::function<void(Seconds)> report_;
  std::mutex mutex_;
  std::condition_variable stop_changed_;
  Clock::time_point started_, reported_;
  bool is_running_ = false;  // a cycle is running
  bool is_stopping_ = false;
  std::thread thread_;
};

}  // namespace sdf_ccd
