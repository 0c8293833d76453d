#pragma once

#include <limits>

#include "sdf_ccd/body.h"

namespace sdf_ccd {

constexpr double kPoseEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kPoseRoundings = 16.0;  // rounding steps from a pose to a point in another body's frame

/// Bounds the further error of a point of another body at a time within a step, or at one within a part of it, relative
/// to the point's distance from the frame: each body's pose takes sine, cosine and two products (8 roundings), those of
/// a part as many again; the relative pose takes a product and a difference (8), and the point one more product (4 in
/// each body). A test compares them with long double.
constexpr double kTimeRounding = 64.0 * kPoseEpsilon;

/// |RᵀR − 1| plus rounding; times a point's distance from the body's origin, it bounds the error of the point.
inline double poseDefect(const Isometry3d& X_WB) {
  const Matrix3d& R = X_WB.linear();
  return (R.transpose() * R - Matrix3d::Identity()).norm() + kPoseRoundings * kPoseEpsilon;
}

/// Rounding error of the pose's translation [m].
inline double poseRounding(const Isometry3d& X_WB) {
  return kPoseRoundings * kPoseEpsilon * X_WB.translation().norm();
}

}  // namespace sdf_ccd
