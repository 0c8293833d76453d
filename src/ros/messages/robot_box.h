#pragma once

#include <vector>

#include "ros/messages/conversions.h"

namespace sdf_ccd {

/// Where the links are, for the size and place of what is drawn about them; of the world's objects if there are no
/// links.
class RobotBox {
 public:
  /// Takes the poses at the end of what was checked; bodies without a known pose stay where they were.
  void update(const CycleResult& result, const CycleContext& cycle);

  /// The diagonal of the box around all links, in steps of a fifth, so that it seldom changes; 1.5 while nothing is
  /// known [m].
  double size() const { return size_; }

  /// A point above the middle of the box, which moves only if that has moved by a seventh of the size [m], fixed frame.
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
