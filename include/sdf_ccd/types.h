#pragma once

#include <Eigen/Geometry>

/// Linear algebra types used throughout. Lengths are metres, angles radians, times seconds.
///
/// `X_WF` is the pose of frame F in frame W (p_W = X_WF * p_F), `R_WF` its rotation and `p_WF` its translation;
/// `p_F` is a point expressed in F. Frames: W world, B body, F the field's body, P the shell's body.
namespace sdf_ccd {

using Eigen::AlignedBox3d;
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::Vector3f;
using Eigen::Vector3i;

/// A ball in frame P that holds the points of interest.
struct BoundingBall {
  Vector3d center = Vector3d::Zero();  ///< [m], frame P
  double radius = 0.0;                 ///< [m]
};

}  // namespace sdf_ccd
