#include "two_body_motion.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {
namespace {

/// Bound of |(ω_P − ω_F) × b| over P's ball and all s.
double bendBound(const Vector3d& omega_relative, const WorldTwist& P) {
  const double relative = omega_relative.norm(), own = P.omega.norm(), speed = P.speed();
  const double drifting = omega_relative.cross(P.velocity).norm() + relative * own * (P.radius + 0.5 * speed);
  if (own == 0.0) return drifting;
  // Along P's own axis the product's length is the same at all s, as b rotates about that axis.
  const Vector3d axis = P.omega / own;
  const double along = omega_relative.dot(axis);
  const double across = (omega_relative - along * axis).norm();
  const double turning = std::abs(along) * (axis.cross(P.velocity).norm() + own * P.radius) + across * speed;
  return std::min(drifting, turning);
}

}  // namespace

double maxDisplacement(const Isometry3d& X_from, const Isometry3d& X_to, const BoundingBall& ball) {
  // Two rotations an angle θ apart differ by 2 sin(θ/2) in the spectral norm and √2 times that in Frobenius'.
  const double rotation = std::sqrt(0.5) * (X_to.linear() - X_from.linear()).norm();
  return (X_to * ball.center - X_from * ball.center).norm() + rotation * ball.radius;
}

WorldTwist worldTwist(const ScrewMotion& X_WB, const BoundingBall& ball_B) {
  WorldTwist twist;
  twist.radius = ball_B.radius;
  twist.center = X_WB.pose(0.5) * ball_B.center;
  twist.omega = X_WB.angularVelocity();
  twist.velocity = X_WB.velocity(0.5, ball_B.center);
  return twist;
}

RelativeMotionBounds relativeMotionBounds(const WorldTwist& F, const WorldTwist& P) {
  const Vector3d omega = P.omega - F.omega;
  const Vector3d F_at_P = F.velocityAt(P.center);
  const Vector3d u = P.velocity - F_at_P;
  const double speed = P.speed(), rotation = omega.norm(), rotation_F = F.omega.norm();
  RelativeMotionBounds bounds;
  // The time from the middle is ¼ on average and ½ at most.
  const double together = u.norm() + rotation * (P.radius + 0.25 * speed);
  const double apart = speed + F_at_P.norm() + rotation_F * (P.radius + 0.25 * speed);
  bounds.travel = std::min(together, apart);
  bounds.acceleration =
      F.omega.cross(u).norm() + rotation_F * rotation * (P.radius + 0.5 * speed) + bendBound(omega, P);
  return bounds;
}

}  // namespace sdf_ccd
