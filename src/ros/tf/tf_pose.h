#pragma once

#include <geometry_msgs/Transform.h>
#include <ros/time.h>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// A transform of a frame in its parent, as it was recorded.
struct TfPose {
  ros::Time stamp;
  Quaterniond rotation = Quaterniond::Identity();  ///< of unit length
  Vector3d translation = Vector3d::Zero();         ///< [m]
  const char* problem = nullptr;                   ///< what is wrong with it, as in "hand …"; null if nothing is

  Isometry3d isometry() const { return Eigen::Translation3d(translation) * rotation; }
};

/// Numbers that are not finite, translations beyond kFarthestPose and quaternions whose squared length is off by more
/// than a hundredth (tf2 ignores those) are a problem; other quaternions are normalised.
TfPose toTfPose(const ros::Time& stamp, const geometry_msgs::Transform& transform);

/// Whether the frame rests between them.
bool isSamePlace(const TfPose& a, const TfPose& b);

/// Between two transforms as tf2 interpolates: the translation evenly on a line, the rotation evenly about one axis,
/// the shorter way round (slerp).
class TfInterpolation {
 public:
  TfInterpolation() = default;
  TfInterpolation(const TfPose& a, const TfPose& b);

  /// @param share  of the time from a to b, in [0, 1].
  Isometry3d at(double share) const;

  /// How far the frame turns [rad].
  double angle() const { return 2.0 * half_angle_; }

 private:
  Quaterniond a_ = Quaterniond::Identity(), b_ = Quaterniond::Identity();  // no more than half a turn apart
  Vector3d from_ = Vector3d::Zero(), way_ = Vector3d::Zero();
  double half_angle_ = 0.0, inverse_sine_ = 0.0;  // between the quaternions; 0 if they are as good as the same
};

}  // namespace sdf_ccd
