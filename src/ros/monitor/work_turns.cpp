#include "ros/monitor/work_turns.h"

#include <stdexcept>
#include <string>

namespace sdf_ccd {

WorkTurns::Caller::Caller(WorkTurns& turns) : turns_(turns) {
  const std::lock_guard<std::mutex> lock(turns.mutex_);
  if (turns.callers_ == turns.most_) {
    throw std::runtime_error("busy: " + std::to_string(turns.most_) + " queries are being answered; try again later");
  }
  ++turns.callers_;
}

WorkTurns::Caller::~Caller() {
  const std::lock_guard<std::mutex> lock(turns_.mutex_);
  --turns_.callers_;
}

WorkTurns::Turn::Turn(WorkTurns& turns) : turns_(turns) {
  std::unique_lock<std::mutex> lock(turns.mutex_);
  const std::uint64_t ticket = turns.tickets_++;
  turns.next_.wait(lock, [&] { return turns.turn_ == ticket; });
}

WorkTurns::Turn::~Turn() {
  {
    const std::lock_guard<std::mutex> lock(turns_.mutex_);
    ++turns_.turn_;
  }
  turns_.next_.notify_all();
}

}  // namespace sdf_ccd
