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

/// Force [N] and torque [N·m] about a reference point, or impulse [N·s] and angular impulse [N·m·s], in the axes of
/// one frame. Which point and which frame is said where it is used.
struct Wrench {
  Vector3d force = Vector3d::Zero();
  Vector3d torque = Vector3d::Zero();

  /// Adds a wrench about the same point, in the same axes.
  Wrench& operator+=(const Wrench& other) {
    force += other.force;
    torque += other.torque;
    return *this;
  }
};

/// Scales force and torque.
inline Wrench operator*(double factor, const Wrench& w) {
  return {factor * w.force, factor * w.torque};
}

/// The wrench `w_C`, about C's origin in C's axes, about B's origin in B's axes.
inline Wrench expressedIn(const Isometry3d& X_CB, const Wrench& w_C) {
  const Matrix3d R_BC = X_CB.linear().transpose();
  return {R_BC * w_C.force, R_BC * (w_C.torque - X_CB.translation().cross(w_C.force))};
}

}  // namespace sdf_ccd
