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
    if (options.frames != options_.frames) has_ever_come_.assign(options.frames.size(), 0);
    options_ = options;
    if (due_.count() > 0) due_ = std::min(due_, now() + period());
    takeNews();
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
  const auto awaited = std::find(has_ever_come_.begin(), has_ever_come_.end(), 0);
  return awaited == has_ever_come_.end() ? "" : options_.frames[awaited - has_ever_come_.begin()];
}

void CycleTrigger::takeNews() {
  news_ = false;
  has_come_.assign(options_.frames.size(), 0);
  to_come_ = options_.frames.size();
}

void CycleTrigger::bring(TriggerKind kind) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (options_.kind != kind || news_) return;
    news_ = true;
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
    has_ever_come_[frame] = 1;
    char& has_come = has_come_[frame];
    if (news_ || has_come) return;
    has_come = 1;
    if (--to_come_ > 0) return;
    news_ = true;
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
      waitUntil(now() + toNanoseconds(options_.patience), [&] { return stop_ || news_; });
    }
  }
  if (woken_ && !stop_) doBetween();
  takeNews();
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
