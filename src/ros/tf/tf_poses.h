#pragma once

#include <cstddef>
#include <vector>

#include "ros/tf/tf_pose.h"

namespace sdf_ccd {

/// Transforms of a frame with increasing stamps, in a ring buffer: memory is allocated only if it has to hold more than
/// ever before.
class TfPoses {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  const TfPose& operator[](std::size_t i) const { return ring_[slot(i)]; }
  const TfPose& front() const { return (*this)[0]; }
  const TfPose& back() const { return (*this)[size_ - 1]; }

  /// Index of the last one that is not later than `time`; 0 if all are. Times near the newest are found fastest.
  std::size_t lastUpTo(const ros::Time& time) const;

  /// Removes all and frees the memory of a large ring.
  void clear();

  void pushBack(const TfPose& pose) { insert(size_, pose); }

  /// Inserts one after the first `i`.
  void insert(std::size_t i, const TfPose& pose);

  void dropFront(std::size_t count);

 private:
  std::size_t slot(std::size_t i) const { return first_ + i < ring_.size() ? first_ + i : first_ + i - ring_.size(); }
  void grow();

  std::vector<TfPose> ring_;
  std::size_t first_ = 0, size_ = 0;
};

}  // namespace sdf_ccd
