#pragma once

#include <geometry_msgs/Transform.h>
#include <ros/time.h>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A transform of a frame in its parent, as it was recorded.
struct TfPose {
  ros::Time stamp;
  Quaterniond rotation = Quaterniond::Identity();  ///< of unit length
  Vector3d translation = Vector3d::Zero();         ///< [m]
  const char* problem = nullptr;  ///< what is wrong with it, to be read after the frame's name; null if it is valid

  Isometry3d isometry() const { return Eigen::Translation3d(translation) * rotation; }
};

/// Sets TfPose::problem for numbers that are not finite, translations beyond kFarthestPose and quaternions whose
/// squared length is off by more than 0.01 (tf2 ignores those); other quaternions are normalised.
TfPose toTfPose(const ros::Time& stamp, const geometry_msgs::Transform& transform);

/// Whether the poses are equal: the frame rests between them.
bool isSamePose(const TfPose& a, const TfPose& b);

/// Interpolation between two transforms as in tf2: the translation linearly, the rotation at a constant rate about one
/// axis, along the shorter arc (slerp).
class TfInterpolation {
 public:
  TfInterpolation() = default;
  TfInterpolation(const TfPose& a, const TfPose& b);

  /// @param share  fraction of the time from a to b, in [0, 1].
  Isometry3d at(double share) const;

  /// Rotation angle from a to b [rad].
  double angle() const { return 2.0 * half_angle_; }

 private:
  Quaterniond a_ = Quaterniond::Identity(), b_ = Quaterniond::Identity();  // with a_ · b_ >= 0: the shorter arc
  Vector3d from_ = Vector3d::Zero(), displacement_ = Vector3d::Zero();
  double half_angle_ = 0.0, inverse_sine_ = 0.0;  // angle between the quaternions; 0 if they are equal to rounding
};

}  // namespace sdf_ccd
