#include "ros/monitor/cycle_watchdog.h"

#include <algorithm>
#include <utility>

namespace sdf_ccd {

CycleWatchdog::CycleWatchdog(Seconds limit, std::function<void(Seconds)> report)
    : limit_(limit), report_(std::move(report)), thread_([this] { run(); }) {}

CycleWatchdog::~CycleWatchdog() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_stopping_ = true;
  }
  stop_changed_.notify_all();
  thread_.join();
}

void CycleWatchdog::begin() {
  const std::lock_guard<std::mutex> lock(mutex_);
  started_ = reported_ = Clock::now();
  is_running_ = true;
}

void CycleWatchdog::end() {
  const std::lock_guard<std::mutex> lock(mutex_);
  is_running_ = false;
}

/// Polls, as a notification in each cycle would wake this thread up to a thousand times a second.
void CycleWatchdog::run() {
  const Seconds period = std::clamp(0.25 * limit_, Seconds(1e-3), Seconds(0.1));
  std::unique_lock<std::mutex> lock(mutex_);
  while (!stop_changed_.wait_for(lock, period, [this] { return is_stopping_; })) {
    const Clock::time_point now = Clock::now();
    if (!is_running_ || now - reported_ < limit_) continue;
    reported_ = now;
    report_(now - started_);  // under the lock: the cycle's own messages come after this one
  }
}

}  // namespace sdf_ccd
