#include <algorithm>
#include <utility>

#include "common/cancel_point.h"

namespace sdf_ccd {
namespace {

thread_local CancelRequest current;

}  // namespace

CancelScope::CancelScope(const std::atomic<bool>& requested)
    : outer_flag_(std::exchange(current.requested, &requested)), outer_deadline_(current.deadline) {}

CancelScope::CancelScope(Clock::time_point deadline)
    : outer_flag_(current.requested),
      outer_deadline_(std::exchange(current.deadline, std::min(current.deadline, deadline))) {}

CancelScope::~CancelScope() {
  current = {outer_flag_, outer_deadline_};
}

TaskCancelScope::TaskCancelScope(const CancelPoint& point) : outer_(std::exchange(current, point.request())) {}

TaskCancelScope::~TaskCancelScope() {
  current = outer_;
}

CancelPoint::CancelPoint() : request_(current) {}

}  // namespace sdf_ccd
