#pragma once

#include <vector>

#include "ros/messages/conversions.h"

namespace sdf_ccd {

/// Bounding box of the links, for the size and position of markers; of the world's objects if there are no links.
class RobotBox {
 public:
  /// Takes the poses at the end of the checked time; bodies without a known pose keep their last one.
  void update(const CycleResult& result, const CycleContext& cycle);

  /// Diagonal of the box around all links, rounded to steps of a fifth so that it seldom changes; 1.5 while nothing is
  /// known [m].
  double size() const { return size_; }

  /// A point above the centre of the box, in the fixed frame [m]. It moves only if that has moved by a seventh of the
  /// size.
  const Vector3d& top() const { return top_; }

 private:
  struct Ball {
    bool is_known = false;
    Vector3d center_W = Vector3d::Zero();
  };

  std::vector<Ball> balls_;  // per body
  double size_ = 1.5;
  Vector3d top_ = Vector3d::UnitZ();
};

}  // namespace sdf_ccd
