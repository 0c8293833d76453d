#include "sdf_ccd/cancel.h"

#include <algorithm>
#include <utility>

namespace sdf_ccd {
namespace {

thread_local CancelRequest current;

}  // namespace

CancelScope::CancelScope(const std::atomic<bool>& requested)
    : outer_(std::exchange(current, {&requested, current.deadline})) {}

CancelScope::CancelScope(CancelRequest::Clock::time_point deadline)
    : outer_(std::exchange(current, {current.requested, std::min(current.deadline, deadline)})) {}

CancelScope::CancelScope(const CancelPoint& point) : outer_(std::exchange(current, point.request())) {}

CancelScope::~CancelScope() {
  current = outer_;
}

CancelPoint::CancelPoint() : request_(current) {}

}  // namespace sdf_ccd
