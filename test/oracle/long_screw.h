#pragma once

#include <cmath>

#include "sdf_ccd/types.h"

/// Motions of constant twist in long double, independent of src/motion/, as a reference for it.
namespace sdf_ccd::test {

using Real = long double;
using Vector3l = Eigen::Matrix<Real, 3, 1>;
using Matrix3l = Eigen::Matrix<Real, 3, 3>;

struct LongPose {
  Matrix3l R = Matrix3l::Identity();
  Vector3l p = Vector3l::Zero();

  LongPose() = default;
  LongPose(const Matrix3l& rotation, const Vector3l& place) : R(rotation), p(place) {}
  explicit LongPose(const Isometry3d& X) : R(X.linear().cast<Real>()), p(X.translation().cast<Real>()) {}

  Vector3l operator*(const Vector3l& q) const { return R * q + p; }
  LongPose operator*(const LongPose& X) const { return {R * X.R, R * X.p + p}; }
};

inline Matrix3l crossMatrix(const Vector3l& v) {
  Matrix3l m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Rotation vector of a matrix that is a rotation to rounding [rad], its length in [0, π].
inline Vector3l rotationVector(const Matrix3l& R) {
  const Eigen::Quaternion<Real> q = Eigen::Quaternion<Real>(R).normalized();
  const Real sine = q.vec().norm(), sign = q.w() < 0 ? -1 : 1;
  return sine == 0 ? Vector3l(2 * sign * q.vec())
                   : Vector3l(2 * std::atan2(sine, sign * q.w()) * sign / sine * q.vec());
}

/// X(s) = X(0) exp(s ξ) for s in [0, 1]: the twist ξ is constant in the body, and so in the world.
class LongScrew {
 public:
  LongScrew(const LongPose& start, const LongPose& end) : start_(start) {
    omega_ = rotationVector(start.R.transpose() * end.R);
    velocity_ = shift(omega_, 1).inverse() * (start.R.transpose() * (end.p - start.p));
  }
  LongScrew(const Isometry3d& start, const Isometry3d& end) : LongScrew(LongPose(start), LongPose(end)) {}
  LongScrew(const LongPose& start, const Vector3l& omega_B, const Vector3l& velocity_B)
      : start_(start), omega_(omega_B), velocity_(velocity_B) {}

  LongPose pose(Real s) const {
    const Real angle = s * omega_.norm();
    Matrix3l R = Matrix3l::Identity();
    if (angle > 0) R = Eigen::AngleAxis<Real>(angle, omega_.normalized()).toRotationMatrix();
    return start_ * LongPose(R, shift(omega_, s) * velocity_);
  }

  /// |ω × p + v|, which is the same at all s [m per unit of s].
  Real speed(const Vector3l& p_B) const { return velocity(p_B).norm(); }

  /// Velocity of a point, in the body's frame [m per unit of s].
  Vector3l velocity(const Vector3l& p_B) const { return omega_.cross(p_B) + velocity_; }

  /// Angular speed [rad per unit of s].
  Real turningSpeed() const { return omega_.norm(); }

 private:
  /// ∫₀ˢ exp(u ω) du.
  static Matrix3l shift(const Vector3l& omega, Real s) {
    const Real rate = omega.norm(), angle = s * rate;
    const Matrix3l w = crossMatrix(omega);
    Real first = s * s / 2 - s * s * angle * angle / 24, second = s * s * s / 6 - s * s * s * angle * angle / 120;
    if (angle > 1e-4L) {
      const Real half = std::sin(angle / 2);
      first = 2 * half * half / (rate * rate);
      second = (angle - std::sin(angle)) / (rate * rate * rate);
    }
    return s * Matrix3l::Identity() + first * w + second * w * w;
  }

  LongPose start_;
  Vector3l omega_, velocity_;  // frame B
};

inline Isometry3d rounded(const LongPose& X) {
  Isometry3d result = Isometry3d::Identity();
  result.linear() = X.R.cast<double>();
  result.translation() = X.p.cast<double>();
  return result;
}

}  // namespace sdf_ccd::test
