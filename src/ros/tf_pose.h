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

/// How far the frame turns from one to the other, the shorter way round, as tf2 does [rad].
double angleBetween(const TfPose& a, const TfPose& b);

/// As tf2 interpolates: the translation evenly on a line, the rotation evenly about one axis (slerp).
/// @param share  of the time from a to b, in [0, 1].
Isometry3d interpolate(const TfPose& a, const TfPose& b, double share);

}  // namespace sdf_ccd
