#include "screw_motion.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

namespace {

bool isRotation(const Matrix3d& R) {
  return (R.transpose() * R).isIdentity(1e-6) && R.determinant() >= 0.0;
}

}  // namespace

void requirePose(const Isometry3d& X, const std::string& what) {
  if (!X.matrix().allFinite()) throw std::invalid_argument(what + " is not finite");
  if (!isRotation(X.linear())) throw std::invalid_argument(what + "'s rotation is not orthonormal");
}

namespace {

/// Accepts good rotations by arithmetic alone: most are far more accurate than required.
void requirePoses(const Isometry3d& start, const Isometry3d& end) {
  constexpr double kSurely = 1e-20;  // the squared deviation of RᵀR; false for NaN
  for (const Isometry3d* X : {&start, &end}) {
    const auto R = X->linear();
    const bool is_orthonormal = (R.transpose() * R - Matrix3d::Identity()).squaredNorm() <= kSurely;
    const bool is_finite = X->translation().squaredNorm() <= std::numeric_limits<double>::max();
    if (!is_orthonormal || !is_finite || R.determinant() < 0.0) requirePose(*X, "screw motion: a pose");
  }
}

/// Rotation vector of R, in [0, π].
Vector3d rotationLog(const Matrix3d& R) {
  Quaterniond q(R);
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const double sine = q.vec().norm();
  if (sine < 1e-9) return 2.0 * q.vec();
  return 2.0 * std::atan2(sine, q.w()) / sine * q.vec();
}

/// Coefficients of exp and log on SE(3), with series where the angle makes them 0/0:
/// (1 − cos θ)/θ² and (θ − sin θ)/θ³.
struct ExpCoefficients {
  double b, c;
};
ExpCoefficients expCoefficients(double theta) {
  if (theta < 1e-2) {
    const double t2 = theta * theta;
    return {0.5 - t2 / 24.0 + t2 * t2 / 720.0, 1.0 / 6.0 - t2 / 120.0 + t2 * t2 / 5040.0};
  }
  return {(1.0 - std::cos(theta)) / (theta * theta), (theta - std::sin(theta)) / (theta * theta * theta)};
}

/// Of log on SE(3): (1 − θ/2 cot(θ/2))/θ², with a series where the angle makes it 0/0.
double logCoefficient(double theta) {
  const double t2 = theta * theta;
  if (theta < 1e-2) return 1.0 / 12.0 + t2 / 720.0 + t2 * t2 / 30240.0;
  return (1.0 - 0.5 * theta / std::tan(0.5 * theta)) / t2;
}

Isometry3d exponential(const Vector3d& omega, const Vector3d& velocity) {
  const double theta = omega.norm();
  Isometry3d X = Isometry3d::Identity();
  if (theta > 0.0) X.linear() = Eigen::AngleAxisd(theta, omega / theta).toRotationMatrix();
  const auto [b, c] = expCoefficients(theta);
  const Vector3d crossed = omega.cross(velocity);
  X.translation() = velocity + b * crossed + c * omega.cross(crossed);
  return X;
}

/// The pose halfway to X along its twist: half of the rotation, whose quaternion is halfway between 1 and that of X. On
/// an arc of angle θ about the axis a, the chord up to the middle is 1/(2 cos θ/4) of the whole one and lies θ/4
/// behind it:
/// t(½) = ½ (t − tan(θ/4) a × t).
Isometry3d halfway(const Isometry3d& X) {
  Quaterniond q(X.linear());
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();
  const Vector3d tangent = q.vec() / (1.0 + q.w());
  q.w() += 1.0;
  Isometry3d half;
  half = Eigen::Translation3d(0.5 * (X.translation() - tangent.cross(X.translation()))) * q.normalized();
  return half;
}

}  // namespace

ScrewMotion::ScrewMotion(const Isometry3d& X_FP_start, const Isometry3d& X_FP_end)
    : start_(X_FP_start), end_(X_FP_end) {
  requirePoses(start_, end_);
  omega_.setZero();
  velocity_.setZero();
  if (start_.matrix() == end_.matrix()) return;  // exactly at rest
  const Isometry3d X = start_.inverse() * end_;
  omega_ = rotationLog(X.linear());
  // Log on SE(3): velocity = V(ω)⁻¹ translation, with V⁻¹ = 1 − ½ [ω] + c [ω]².
  const Vector3d crossed = omega_.cross(X.translation());
  velocity_ = X.translation() - 0.5 * crossed + logCoefficient(omega_.norm()) * omega_.cross(crossed);
}

Isometry3d ScrewMotion::pose(double s) const {
  if (s <= 0.0) return start_;
  if (s >= 1.0) return end_;
  if (omega_.isZero(0.0) && velocity_.isZero(0.0)) return start_;
  if (s == 0.5) return start_ * halfway(start_.inverse() * end_);  // without sines
  return start_ * exponential(s * omega_, s * velocity_);
}

Vector3d ScrewMotion::velocity(double s, const Vector3d& p_P) const {
  return pose(s).linear() * (omega_.cross(p_P) + velocity_);
}

double ScrewMotion::maxTravel(const BoundingBall& ball) const {
  return (omega_.cross(ball.center) + velocity_).norm() + omega_.norm() * ball.radius;
}

double ScrewMotion::maxAcceleration(const BoundingBall& ball) const {
  const double theta = omega_.norm();
  return omega_.cross(omega_.cross(ball.center) + velocity_).norm() + theta * theta * ball.radius;
}

void requireUnambiguousTurns(const std::vector<Isometry3d>& poses, const std::string& what) {
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Matrix3d R = poses[i - 1].linear().transpose() * poses[i].linear();
    if (!(R.transpose() * R).isIdentity(1e-5)) continue;  // invalid poses are reported by their user
    if (R.determinant() > 0.0 && rotationLog(R).norm() >= kAmbiguousTurn)
      throw std::invalid_argument(what + " rotates by half a revolution between poses " + std::to_string(i - 1) +
                                  " and " + std::to_string(i) +
                                  ", so the direction is ambiguous; add a pose in between");
  }
}

}  // namespace sdf_ccd
