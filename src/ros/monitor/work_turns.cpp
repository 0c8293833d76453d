#include "ros/monitor/work_turns.h"

#include <stdexcept>
#include <string>

namespace sdf_ccd {

WorkTurns::Caller::Caller(WorkTurns& turns) : turns_(turns) {
  const std::lock_guard<std::mutex> lock(turns.mutex_);
  if (turns.callers_ == turns.max_callers_) {
    throw std::runtime_error("busy: " + std::to_string(turns.max_callers_) +
                             " queries are being answered; try again later");
  }
  ++turns.callers_;
}

WorkTurns::Caller::~Caller() {
  const std::lock_guard<std::mutex> lock(turns_.mutex_);
  --turns_.callers_;
}

WorkTurns::Turn::Turn(WorkTurns& turns) : turns_(turns) {
  std::unique_lock<std::mutex> lock(turns.mutex_);
  const std::uint64_t ticket = turns.next_ticket_++;
  turns.served_changed_.wait(lock, [&] { return turns.served_ticket_ == ticket; });
}

WorkTurns::Turn::~Turn() {
  {
    const std::lock_guard<std::mutex> lock(turns_.mutex_);
    ++turns_.served_ticket_;
  }
  turns_.served_changed_.notify_all();
}

}  // namespace sdf_ccd
