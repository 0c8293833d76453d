#include "sdf_ccd/geometry/cancel.h"

#include <utility>

namespace sdf_ccd {
namespace {

thread_local const std::atomic<bool>* current = nullptr;

}  // namespace

CancelScope::CancelScope(const std::atomic<bool>& asked) : outer_(std::exchange(current, &asked)) {}

CancelScope::~CancelScope() {
  current = outer_;
}

CancelPoint::CancelPoint() : asked_(current) {}

}  // namespace sdf_ccd
