#include "ros/monitor/work_turns.h"

#include <chrono>
#include <stdexcept>

#include "common/cancel_point.h"

namespace sdf_ccd {

WorkTurns::Caller::Caller(WorkTurns& turns) : turns_(turns) {
  const std::lock_guard<std::mutex> lock(turns.mutex_);
  if (turns.callers_ == turns.max_callers_)
    throw std::runtime_error("busy: " + std::to_string(turns.max_callers_) + " " + turns.what_ + "; try again later");
  ++turns.callers_;
}

WorkTurns::Caller::~Caller() {
  const std::lock_guard<std::mutex> lock(turns_.mutex_);
  --turns_.callers_;
}

WorkTurns::Turn::Turn(WorkTurns& turns) : turns_(turns) {
  constexpr std::chrono::milliseconds kPollPeriod(20);
  const CancelPoint cancel;
  std::unique_lock<std::mutex> lock(turns.mutex_);
  place_ = turns.queue_.insert(turns.queue_.end(), this);
  while (place_ != turns.queue_.begin()) {
    turns.first_changed_.wait_for(lock, kPollPeriod);
    if (!cancel.requested()) continue;
    turns.queue_.erase(place_);
    throw Cancelled();
  }
}

WorkTurns::Turn::~Turn() {
  {
    const std::lock_guard<std::mutex> lock(turns_.mutex_);
    turns_.queue_.erase(place_);
  }
  turns_.first_changed_.notify_all();
}

}  // namespace sdf_ccd
