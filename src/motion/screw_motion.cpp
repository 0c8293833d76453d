#include "sdf_ccd/motion/screw_motion.h"

#include <cmath>
#include <stdexcept>

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

/// Without a text, which takes memory, where all is well.
void requirePoses(const Isometry3d& start, const Isometry3d& end) {
  for (const Isometry3d* X : {&start, &end})
    if (!X->matrix().allFinite() || !isRotation(X->linear())) requirePose(*X, "screw motion: a pose");
}

Matrix3d skew(const Vector3d& v) {
  Matrix3d S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
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

Isometry3d exponential(const Vector3d& omega, const Vector3d& velocity) {
  const double theta = omega.norm();
  Isometry3d X = Isometry3d::Identity();
  if (theta > 0.0) X.linear() = Eigen::AngleAxisd(theta, omega / theta).toRotationMatrix();
  const auto [b, c] = expCoefficients(theta);
  const Vector3d turned = omega.cross(velocity);
  X.translation() = velocity + b * turned + c * omega.cross(turned);
  return X;
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
  // Log on SE(3): translation = V(ω) velocity, with V = 1 + b [ω] + c [ω]².
  const auto [b, c] = expCoefficients(omega_.norm());
  const Matrix3d W = skew(omega_);
  const Matrix3d V = Matrix3d::Identity() + b * W + c * W * W;
  velocity_ = V.partialPivLu().solve(X.translation());
}

Isometry3d ScrewMotion::pose(double s) const {
  if (s <= 0.0) return start_;
  if (s >= 1.0) return end_;
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
    if (!(R.transpose() * R).isIdentity(1e-5)) continue;  // no poses: whoever takes them says so
    if (R.determinant() > 0.0 && rotationLog(R).norm() >= kAmbiguousTurn)
      throw std::invalid_argument(what + " turns by half a revolution up to poses " + std::to_string(i) +
                                  ": they do not tell which way, one between them would");
  }
}

}  // namespace sdf_ccd
