#pragma once

#include <cmath>
#include <optional>

#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// The normalised quaternion; none if its squared length is not 1 within 0.01, as in tf2, or not finite.
inline std::optional<Quaterniond> unitRotation(const Quaterniond& q) {
  constexpr double kMaxError = 1e-2;
  if (!(std::abs(q.squaredNorm() - 1.0) <= kMaxError)) return std::nullopt;
  return q.normalized();
}

/// The pose; none if q is not a unit quaternion.
inline std::optional<Isometry3d> poseOf(const Vector3d& p, const Quaterniond& q) {
  const std::optional<Quaterniond> rotation = unitRotation(q);
  if (!rotation) return std::nullopt;
  return Isometry3d(Eigen::Translation3d(p) * *rotation);
}

/// Whether the point can be part of a pose; false for NaN, which lpNorm() may ignore.
inline bool isNearOrigin(const Vector3d& p) {
  return (p.array().abs() <= kFarthestPose).all();
}

}  // namespace sdf_ccd
