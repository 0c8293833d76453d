#include "swept_bodies.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace sdf_ccd {
namespace {

constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
constexpr double kRoundings = 16.0;  // products and sums on the way from a pose to a point in another body's frame

/// Throws if a body is so far away that its coordinates are too coarse.
void requireNear(const std::string& name, const Isometry3d& X_WB) {
  const double distance = X_WB.translation().lpNorm<Eigen::Infinity>();
  if (distance <= kFarthestPose) return;
  throw std::runtime_error(
      fmt::format("{} is {:.3g} m from the origin, more than {:.0g} m", name, distance, kFarthestPose));
}

double defectOf(const Matrix3d& R) {
  return (R.transpose() * R - Matrix3d::Identity()).norm() + kRoundings * kEpsilon;
}

}  // namespace

void SweptBodies::take(const CycleMotion& motion, const std::vector<PairResult>& pairs) {
  times_ = &motion.times;
  for (SweptBody& body : bodies_) {
    body.first = motion.times.size();
    body.last = 0;
  }
  for (const PairResult& pair : pairs) {
    if (pair.span.empty()) continue;
    for (const int body : {pair.body_a, pair.body_b}) {
      bodies_[body].first = std::min(bodies_[body].first, pair.span.first);
      bodies_[body].last = std::max(bodies_[body].last, pair.span.last);
    }
  }
  for (std::size_t body = 0; body < bodies_.size(); ++body) {
    const bool known = scene_.bodies[body].failure.empty() && (motion.missing.empty() || motion.missing[body].empty());
    if (known && bodies_[body].first < bodies_[body].last) sweep(motion, static_cast<int>(body));
  }
}

void SweptBodies::sweep(const CycleMotion& motion, int body) {
  SweptBody& swept = bodies_[body];
  const std::vector<Isometry3d>& X_WB = motion.X_WB[body];
  swept.intervals.clear();
  swept.problem.clear();
  swept.defect = swept.rounding = 0.0;
  try {
    for (std::size_t k = swept.first; k < swept.last; ++k) {
      requireNear(scene_.bodies[body].name, X_WB[k]);
      requireNear(scene_.bodies[body].name, X_WB[k + 1]);
      const ScrewMotion screw(X_WB[k], X_WB[k + 1]);
      swept.intervals.push_back({screw, worldTwist(screw, scene_.bodies[body].ball)});
    }
    for (std::size_t k = swept.first; k <= swept.last; ++k) {
      swept.defect = std::max(swept.defect, defectOf(X_WB[k].linear()));
      swept.rounding = std::max(swept.rounding, kRoundings * kEpsilon * X_WB[k].translation().norm());
    }
  } catch (const std::exception& error) {
    swept.problem = error.what();
  }
}

}  // namespace sdf_ccd
