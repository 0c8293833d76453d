#include "ros/monitor/world_handover.h"

#include <chrono>

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

using Clock = std::chrono::steady_clock;

constexpr auto kAdoptPeriod = std::chrono::milliseconds(20);    // for the end of the monitor
constexpr auto kMaxAdoptWait = std::chrono::milliseconds(500);  // longest wait for a cycle to adopt a version

}  // namespace

std::unique_ptr<PreparedWorld> WorldHandover::withdraw() {
  std::uint64_t version = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_) version = waiting_->version;
  }
  waitFor(version);  // otherwise versions in quick succession could replace each other, and none be adopted
  std::unique_ptr<PreparedWorld> former;  // freed without the lock
  const std::lock_guard<std::mutex> lock(mutex_);
  former = std::move(former_);
  return std::move(waiting_);
}

void WorldHandover::offer(std::unique_ptr<PreparedWorld> prepared) {
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_ = std::move(prepared);
}

bool WorldHandover::waitFor(std::uint64_t version) {
  const CancelPoint cancel;
  std::unique_ptr<PreparedWorld> former;  // freed without the lock
  std::unique_lock<std::mutex> lock(mutex_);
  for (const auto start = Clock::now(); adopted_version_ < version;) {
    if (Clock::now() - start > kMaxAdoptWait || cancel.requested()) return false;
    adopted_.wait_for(lock, kAdoptPeriod);
  }
  former = std::move(former_);
  return true;
}

bool WorldHandover::adopt() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!waiting_) return false;
    former_ = std::move(waiting_);  // null until now
    adopt_(*former_);
    adopted_version_ = former_->version;
  }
  adopted_.notify_all();
  return true;
}

}  // namespace sdf_ccd
