#include "chords.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {
namespace {

/// Times of an interval between two recorded poses.
struct Span {
  double t_start, t_end;
  int interval;
};

/// @param poseAt  X_FP at s from 0 to 1.
template <typename PoseAt>
void addChords(const Span& span, double acceleration, const PoseAt& poseAt, const ChordOptions& options,
               ChordPath& path) {
  const double wanted = std::ceil(std::sqrt(acceleration / (8.0 * options.tolerance)));
  const int n = wanted < options.max_chords ? std::max(1, static_cast<int>(wanted)) : options.max_chords;
  path.error = std::max(path.error, acceleration / (8.0 * n * n));
  const double length = span.t_end - span.t_start;
  for (int i = 0; i < n; ++i) {
    const double s0 = double(i) / n, s1 = double(i + 1) / n;
    const bool first = i == 0, last = i + 1 == n;
    const Isometry3d X_start = first ? poseAt(0.0) : path.chords.back().X_FP_end;
    path.chords.push_back({span.t_start + s0 * length, last ? span.t_end : span.t_start + s1 * length, X_start,
                           poseAt(last ? 1.0 : s1), span.interval});
  }
}

/// A body whose origin moves straight.
class Drift {
 public:
  Drift(const Isometry3d& start, const Isometry3d& end)
      : start_(start), end_(end), rotation_(Quaterniond(start.linear().transpose() * end.linear())) {}

  Vector3d velocity() const { return end_.translation() - start_.translation(); }

  /// In the world's axes [rad].
  Vector3d rotation() const { return rotation_.angle() * (start_.linear() * rotation_.axis()); }

  /// Exact at both ends.
  Isometry3d pose(double s) const {
    if (s == 0.0 || s == 1.0) return s == 0.0 ? start_ : end_;
    Isometry3d X = start_ * Eigen::AngleAxisd(s * rotation_.angle(), rotation_.axis());
    X.translation() += s * velocity();
    return X;
  }

 private:
  const Isometry3d &start_, &end_;
  Eigen::AngleAxisd rotation_;  // in the body's axes, by at most half a revolution
};

/// Bound of the acceleration of P's points in F, per unit of s squared [m]. With ρ from P's origin to the point, d from
/// F's origin to P's and their rates of rotation ω and speeds v, in world axes:
///   q'' = [(ω_P − ω_F)×]² ρ + (ω_P × ω_F) × ρ − 2 ω_F × (v_P − v_F) + ω_F × (ω_F × d),
/// whose last term is convex in s, hence largest at an end.
double accelerationBound(const Drift& F, const Drift& P, const BoundingBall& ball) {
  const Vector3d omega_F = F.rotation(), omega_P = P.rotation();
  const double reach = ball.center.norm() + ball.radius;
  const auto turning = [&](double s) {
    return omega_F.cross(omega_F.cross(P.pose(s).translation() - F.pose(s).translation())).norm();
  };
  return ((omega_P - omega_F).squaredNorm() + omega_P.cross(omega_F).norm()) * reach +
         2.0 * omega_F.cross(P.velocity() - F.velocity()).norm() + std::max(turning(0.0), turning(1.0));
}

}  // namespace

void addChords(const TwoBodyMotion& motion, const ChordOptions& options, int interval, ChordPath& path) {
  const auto poseAt = [&](double s) { return motion.X_FP(s); };
  addChords(Span{motion.t_start, motion.t_end, interval}, motion.acceleration, poseAt, options, path);
}

void addChords(const DriftingBodies& motion, const BoundingBall& ball, const ChordOptions& options, int interval,
               ChordPath& path) {
  const Drift F(motion.X_WF_start, motion.X_WF_end), P(motion.X_WP_start, motion.X_WP_end);
  const auto poseAt = [&](double s) { return relativePose(F.pose(s), P.pose(s)); };
  addChords(Span{motion.t_start, motion.t_end, interval}, accelerationBound(F, P, ball), poseAt, options, path);
}

}  // namespace sdf_ccd
