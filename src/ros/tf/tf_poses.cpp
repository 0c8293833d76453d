#include "ros/tf/tf_poses.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

constexpr std::size_t kMin = 8;   // smallest capacity
constexpr std::size_t kFew = 64;  // capacity that clear() keeps

}  // namespace

std::size_t TfPoses::lastUpTo(const ros::Time& time) const {
  std::size_t after = size_;  // all records from here on are later than `time`
  std::size_t step = 1;
  while (after > 0 && (*this)[after - std::min(step, after)].stamp > time) {
    after -= std::min(step, after);
    step *= 2;
  }
  // The record at after - step is not later than `time`, or there is none.
  std::size_t low = after - std::min(step, after);
  while (low < after) {
    const std::size_t middle = low + (after - low) / 2;
    (*this)[middle].stamp > time ? after = middle : low = middle + 1;
  }
  return after == 0 ? 0 : after - 1;
}

void TfPoses::clear() {
  first_ = size_ = 0;
  if (ring_.size() > kFew) std::vector<TfPose>().swap(ring_);
}

void TfPoses::insert(std::size_t i, const TfPose& pose) {
  if (size_ == ring_.size()) grow();
  if (i == 0) {
    first_ = first_ == 0 ? ring_.size() - 1 : first_ - 1;
  } else {
    for (std::size_t k = size_; k > i; --k) ring_[slot(k)] = ring_[slot(k - 1)];
  }
  ++size_;
  ring_[slot(i)] = pose;
}

void TfPoses::dropFront(std::size_t count) {
  first_ = count == size_ ? 0 : slot(count);
  size_ -= count;
}

void TfPoses::grow() {
  std::vector<TfPose> larger(std::max(kMin, ring_.size() + ring_.size() / 2));
  for (std::size_t i = 0; i < size_; ++i) larger[i] = (*this)[i];
  ring_.swap(larger);
  first_ = 0;
}

}  // namespace sdf_ccd
