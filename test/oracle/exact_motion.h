#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "motion/screw_motion.h"
#include "robot/planned_motion.h"
#include "robot/trajectory_motion.h"

/// Motions in long double, by their definitions, and the error of a sampled motion.
namespace sdf_ccd::test {

using Real = long double;
using Vector3r = Eigen::Matrix<Real, 3, 1>;
using Matrix3r = Eigen::Matrix<Real, 3, 3>;
using Pose = Eigen::Transform<Real, 3, Eigen::Isometry>;

inline Pose exact(const Isometry3d& X) {
  return X.cast<Real>();
}

inline Matrix3r skewOf(const Vector3r& v) {
  Matrix3r S;
  S << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return S;
}

inline Vector3r rotationVector(const Matrix3r& R) {
  Eigen::Quaternion<Real> q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Real sine = q.vec().norm();
  return sine < 1e-15L ? Vector3r(2 * q.vec()) : Vector3r(2 * std::atan2(sine, q.w()) / sine * q.vec());
}

inline Matrix3r rotation(const Vector3r& w) {
  const Real angle = w.norm();
  return angle == 0 ? Matrix3r(Matrix3r::Identity()) : Eigen::AngleAxis<Real>(angle, w / angle).toRotationMatrix();
}

/// ∫ exp(u [w]) du from 0 to s: the matrix that maps a constant velocity to the displacement.
inline Matrix3r velocityToDisplacement(const Vector3r& w, Real s) {
  const Real angle = w.norm(), t = angle * s;
  const Matrix3r W = skewOf(w);
  if (t < 1e-3L) return s * (Matrix3r::Identity() + s / 2 * W + s * s / 6 * W * W + s * s * s / 24 * W * W * W);
  return s * Matrix3r::Identity() + (1 - std::cos(t)) / (angle * angle) * W +
         (t - std::sin(t)) / (angle * angle * angle) * W * W;
}

/// The pose at s of the motion with a constant twist and the shorter rotation.
inline Pose screwBetween(const Pose& X_start, const Pose& X_end, Real s) {
  const Pose X = X_start.inverse() * X_end;
  const Vector3r w = rotationVector(X.linear());
  const Vector3r v = velocityToDisplacement(w, 1).partialPivLu().solve(X.translation());
  Pose moved = Pose::Identity();
  moved.linear() = rotation(s * w);
  moved.translation() = velocityToDisplacement(w, s) * v;
  return X_start * moved;
}

/// The pose at s if rotation and translation are interpolated separately, at constant rates.
inline Pose slideAndTurn(const Pose& X_start, const Pose& X_end, Real s) {
  Pose X = Pose::Identity();
  X.linear() = X_start.linear() * rotation(s * rotationVector(X_start.linear().transpose() * X_end.linear()));
  X.translation() = (1 - s) * X_start.translation() + s * X_end.translation();
  return X;
}

/// The pose of a link between two waypoints, by its chain of joints.
inline Pose linkBetween(const RobotModel& robot, const RobotState& from, const RobotState& to, int link, Real s) {
  if (link == 0) return slideAndTurn(exact(from.X_WR), exact(to.X_WR), s);
  const urdf::Joint& joint = robot.jointAbove(link);
  const urdf::Pose& origin = joint.parent_to_joint_origin_transform;
  Pose X = Pose::Identity();
  X.translation() = Vector3r(origin.position.x, origin.position.y, origin.position.z);
  const auto& q = origin.rotation;
  X.linear() = Eigen::Quaternion<Real>(q.w, q.x, q.y, q.z).normalized().toRotationMatrix();
  const auto pose = from.poses.find(joint.name);
  if (pose != from.poses.end()) {
    X = X * slideAndTurn(exact(pose->second), exact(to.poses.at(joint.name)), s);
  } else if (joint.type != urdf::Joint::FIXED) {
    const urdf::Joint* leader = &joint;
    Real factor = 1, offset = 0;
    for (; leader->mimic; leader = robot.urdf().getJoint(leader->mimic->joint_name).get()) {
      offset += factor * leader->mimic->offset;
      factor *= leader->mimic->multiplier;
    }
    const Real start = from.positions.at(leader->name), end = to.positions.at(leader->name);
    const Real position = factor * ((1 - s) * start + s * end) + offset;
    const Vector3r axis = Vector3r(joint.axis.x, joint.axis.y, joint.axis.z).normalized();
    if (joint.type == urdf::Joint::PRISMATIC) {
      X.translation() += X.linear() * (position * axis);
    } else {
      X.linear() = X.linear() * rotation(position * axis);
    }
  }
  return linkBetween(robot, from, to, robot.parent(link), s) * X;
}

/// The largest distance between a ball's point under one pose and under the other, |A p + b|. This is convex in p, so
/// that climbing finds it.
inline double farthestApart(const Pose& X, const Pose& Y, const BoundingBall& ball) {
  const Matrix3r A = X.linear() - Y.linear();
  const Vector3r b = A * ball.center.cast<Real>() + X.translation() - Y.translation();
  Real worst = b.norm();
  for (int k = 0; k < 3; ++k) {
    for (const Real sign : {-1, 1}) {
      Vector3r p = sign * ball.radius * Vector3r::Unit(k);
      for (int step = 0; step < 20; ++step) {
        const Vector3r uphill = A.transpose() * (A * p + b);
        if (uphill.norm() == 0) break;
        p = ball.radius * uphill.normalized();
      }
      worst = std::max(worst, (A * p + b).norm());
    }
  }
  return static_cast<double>(worst);
}

/// The largest distance of any point of a body from its position in the sampled motion. Between two samples, the search
/// in time begins at the worst of `looks` times.
inline double worstError(const RobotModel& robot, const RobotTrajectory& trajectory, const CarriedBody& body,
                         const std::vector<double>& times, const std::vector<Isometry3d>& X_WB, int looks = 8) {
  double worst = 0.0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const auto waypoint = std::upper_bound(trajectory.times.begin(), trajectory.times.end(), times[i - 1]);
    const std::size_t end = std::min<std::size_t>(waypoint - trajectory.times.begin(), trajectory.times.size() - 1);
    const Real t0 = trajectory.times[end - 1], t1 = trajectory.times[end];
    const auto errorAt = [&](double s) {
      const Real time = (1 - s) * Real(times[i - 1]) + s * Real(times[i]);
      const Pose X_WL =
          linkBetween(robot, trajectory.states[end - 1], trajectory.states[end], body.link, (time - t0) / (t1 - t0));
      return farthestApart(X_WL * exact(body.X_LB), screwBetween(exact(X_WB[i - 1]), exact(X_WB[i]), s), body.ball_B);
    };
    double best = 0.5, error = 0.0;
    for (int k = 1; k < looks; ++k) {
      const double here = errorAt(static_cast<double>(k) / looks);
      if (here > error) error = here, best = static_cast<double>(k) / looks;
    }
    for (double step = 0.5 / looks; step > 1e-3; step *= 0.5) {
      for (const double s : {best - step, best + step}) {
        const double here = errorAt(s);
        if (here > error) error = here, best = s;
      }
    }
    worst = std::max(worst, error);
  }
  return worst;
}

}  // namespace sdf_ccd::test
