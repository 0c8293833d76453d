#pragma once

#include <algorithm>
#include <limits>

#include "sdf_ccd/body/body.h"

namespace sdf_ccd {

constexpr double kPoseEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kPoseRoundings = 16.0;  // rounding steps from a pose to a point in another body's frame

/// |RᵀR − 1| plus rounding; times a point's distance from the body's origin, it bounds the error of the point.
inline double poseDefect(const Isometry3d& X_WB) {
  const Matrix3d& R = X_WB.linear();
  return (R.transpose() * R - Matrix3d::Identity()).norm() + kPoseRoundings * kPoseEpsilon;
}

/// Rounding error of the pose's translation [m].
inline double poseRounding(const Isometry3d& X_WB) {
  return kPoseRoundings * kPoseEpsilon * X_WB.translation().norm();
}

/// Whether the body's ball contains all of it; false for a body with a half-space.
inline bool ballContainsBody(const Body& body) {
  return std::all_of(body.parts.begin(), body.parts.end(),
                     [](const BodyPart& part) { return part.field.surfaceBox().sizes().allFinite(); });
}

}  // namespace sdf_ccd
