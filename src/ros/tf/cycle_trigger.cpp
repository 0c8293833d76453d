#include "ros/tf/cycle_trigger.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

using std::chrono::nanoseconds;

nanoseconds toNanoseconds(double seconds) {
  return nanoseconds(static_cast<nanoseconds::rep>(1e9 * std::min(seconds, 1e6)));  // clocks overflow beyond
}

}  // namespace

nanoseconds nextOnGrid(nanoseconds begin, nanoseconds now, nanoseconds period) {
  if (now < begin) return begin + period;
  return begin + ((now - begin) / period + 1) * period;
}

nanoseconds dueAfter(nanoseconds due, nanoseconds begun, nanoseconds period) {
  return std::max(due, begun - period / 2) + period;
}

nanoseconds CycleTrigger::now() {
  return Clock::now().time_since_epoch();
}

nanoseconds CycleTrigger::period() const {
  return std::max(nanoseconds(1), toNanoseconds(options_.period));
}

void CycleTrigger::setOptions(const TriggerOptions& options) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (options.frames != options_.frames) has_ever_arrived_.assign(options.frames.size(), 0);
    options_ = options;
    if (due_.count() > 0) due_ = std::min(due_, now() + period());
    clearEvents();
  }
  changed_.notify_all();
}

bool CycleTrigger::wantsFrames() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return options_.kind == TriggerKind::kFrames;
}

std::string CycleTrigger::awaitedFrame() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (options_.kind != TriggerKind::kFrames) return {};
  const auto awaited = std::find(has_ever_arrived_.begin(), has_ever_arrived_.end(), 0);
  return awaited == has_ever_arrived_.end() ? "" : options_.frames[awaited - has_ever_arrived_.begin()];
}

void CycleTrigger::clearEvents() {
  has_event_ = false;
  has_arrived_.assign(options_.frames.size(), 0);
  awaited_ = options_.frames.size();
}

void CycleTrigger::onEvent(TriggerKind kind) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (options_.kind != kind || has_event_) return;
    has_event_ = true;
  }
  changed_.notify_all();
}

void CycleTrigger::onFrame(const std::string& child) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (options_.kind != TriggerKind::kFrames) return;
    const auto found = std::find(options_.frames.begin(), options_.frames.end(), child);
    if (found == options_.frames.end()) return;
    const auto frame = static_cast<std::size_t>(found - options_.frames.begin());
    has_ever_arrived_[frame] = 1;
    char& has_arrived = has_arrived_[frame];
    if (has_event_ || has_arrived) return;
    has_arrived = 1;
    if (--awaited_ > 0) return;
    has_event_ = true;
  }
  changed_.notify_all();
}

bool CycleTrigger::wait(const std::function<void()>& woken) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto doBetween = [&] {
    woken_ = false;
    lock.unlock();
    if (woken) woken();
    lock.lock();
  };
  const auto waitUntil = [&](const nanoseconds& time, const auto& isDue) {
    const auto end = [&] { return Clock::time_point(std::chrono::duration_cast<Clock::duration>(time)); };
    while (changed_.wait_until(lock, end(), [&] { return woken_ || isDue(); }) && !isDue()) doBetween();
  };
  if (due_.count() > 0) {
    waitUntil(due_, [&] { return stop_; });
    if (options_.kind != TriggerKind::kTimer) {
      waitUntil(now() + toNanoseconds(options_.patience), [&] { return stop_ || has_event_; });
    }
  }
  if (woken_ && !stop_) doBetween();
  clearEvents();
  const bool is_timer = options_.kind == TriggerKind::kTimer && due_.count() > 0;
  due_ = is_timer ? nextOnGrid(due_, now(), period()) : dueAfter(due_, now(), period());
  return !stop_;
}

bool CycleTrigger::waitFor(double seconds) {
  std::unique_lock<std::mutex> lock(mutex_);
  return !changed_.wait_for(lock, toNanoseconds(seconds), [&] { return stop_; });
}

void CycleTrigger::wake() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    woken_ = true;
  }
  changed_.notify_all();
}

void CycleTrigger::stop() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  changed_.notify_all();
}

}  // namespace sdf_ccd
