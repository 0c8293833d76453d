#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// @throws std::invalid_argument, beginning with `what`, unless the pose is finite and its rotation orthonormal to
/// 1e-6.
void requirePose(const Isometry3d& X, const std::string& what);

/// Motion of frame P relative to frame F with a constant twist, from one pose to the next, over s in [0, 1].
///
/// It is exact for a single revolute or prismatic joint between the frames, and the same whichever is taken to rest. A
/// point of P runs on an arc: p_F(s) = X_FP(0) exp(s ξ) p_P. Of the rotations from one pose to the other it is the
/// shortest: poses do not determine the number of revolutions.
class ScrewMotion {
 public:
  /// @throws std::invalid_argument if a pose is not finite or its rotation is not orthonormal to 1e-6.
  ScrewMotion(const Isometry3d& X_FP_start, const Isometry3d& X_FP_end);

  const Isometry3d& start() const { return start_; }
  const Isometry3d& end() const { return end_; }

  /// X_FP at s; exact at both ends.
  Isometry3d pose(double s) const;

  /// Velocity of point p_P in frame F, per unit of s [m].
  Vector3d velocity(double s, const Vector3d& p_P) const;

  /// Rotation over the whole motion [rad], in [0, π].
  double angle() const { return omega_.norm(); }

  /// The same at all s: along the axis, of the angle's length, in frame F's axes [rad].
  Vector3d angularVelocity() const { return start_.linear() * omega_; }

  /// No point of the ball moves farther than this [m].
  double maxTravel(const BoundingBall& ball) const;

  /// No point of the ball is accelerated more than this, per unit of s squared [m]. Along a constant twist the
  /// acceleration |ω × (ω × p + v)| is the same at all times.
  double maxAcceleration(const BoundingBall& ball) const;

  /// The same of the third derivative: |ω × (ω × (ω × p + v))|.
  double maxJerk(const BoundingBall& ball) const { return angle() * maxAcceleration(ball); }

 private:
  Isometry3d start_, end_;
  Vector3d omega_;     // angular part of the twist, frame P [rad]
  Vector3d velocity_;  // linear part of the twist at P's origin, frame P [m]
};

/// @throws std::invalid_argument, beginning with `what`, if a pose is kAmbiguousTurn or more from the one before.
void requireUnambiguousTurns(const std::vector<Isometry3d>& poses, const std::string& what);

}  // namespace sdf_ccd
