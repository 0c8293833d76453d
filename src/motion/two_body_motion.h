#pragma once

#include "screw_motion.h"

namespace sdf_ccd {

/// X_FP from two poses in the world; the origins are subtracted first, to keep the precision far from the world's.
inline Isometry3d relativePose(const Isometry3d& X_WF, const Isometry3d& X_WP) {
  Isometry3d X_FP = Isometry3d::Identity();
  X_FP.linear() = X_WF.linear().transpose() * X_WP.linear();
  X_FP.translation() = X_WF.linear().transpose() * (X_WP.translation() - X_WF.translation());
  return X_FP;
}

/// Upper bound of the displacement of the ball's points between the two poses [m].
double maxDisplacement(const Isometry3d& X_from, const Isometry3d& X_to, const BoundingBall& ball);

/// The twist of a body that moves with a constant one from one pose to the next (s from 0 to 1), as the world sees it.
/// It is the same at all s: the body's points at the position p_W move with velocity + omega × (p_W − center).
struct WorldTwist {
  Vector3d omega = Vector3d::Zero();     ///< world axes [rad]
  Vector3d center = Vector3d::Zero();    ///< of the body's ball at s = ½, in the world [m]
  Vector3d velocity = Vector3d::Zero();  ///< of the ball's centre at s = ½ [m]
  double radius = 0.0;                   ///< of the ball [m]

  Vector3d velocityAt(const Vector3d& p_W) const { return velocity + omega.cross(p_W - center); }

  /// No point of the ball is faster, at any s [m].
  double speed() const { return velocity.norm() + omega.norm() * radius; }
};

WorldTwist worldTwist(const ScrewMotion& X_WB, const BoundingBall& ball_B);

/// How the points of P's ball move in F's frame while both bodies move; per unit of s and of s squared.
struct RelativeMotionBounds {
  double travel = 0.0;        ///< no point goes farther [m]
  double acceleration = 0.0;  ///< no point is accelerated more [m]
};

/// Bounds for two bodies that each move with a constant twist in the world. Their relative motion is no screw then, and
/// relative poses at both ends do not determine it: they may rotate by more than half a revolution to each other.
///
/// With twists (ω, v) in the world's axes, u the velocity of a point of P against F, b its velocity in the world:
///   u = (ω_P − ω_F) × p + v_P − v_F,
///   q'' = −ω_F × u + (ω_P − ω_F) × b   (in F's axes; q the point's position in F)
/// where p moves by no more than the ball's speed times the time from the middle. Both vanish for bodies that move as
/// one.
RelativeMotionBounds relativeMotionBounds(const WorldTwist& F, const WorldTwist& P);

}  // namespace sdf_ccd
