#include "swept_bodies.h"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "pose_rounding.h"

namespace sdf_ccd {
namespace {

/// Throws if a body is so far away that doubles round its coordinates too coarsely.
void requireNear(const std::string& name, const Isometry3d& X_WB) {
  const double distance = X_WB.translation().lpNorm<Eigen::Infinity>();
  if (distance <= kFarthestPose) return;
  throw std::runtime_error(
      fmt::format("{} is {:.3g} m from the origin, more than {:.0g} m", name, distance, kFarthestPose));
}

}  // namespace

void SweptBodies::sweepDue(const CycleMotion& motion, const std::vector<PairResult>& pairs,
                           const std::vector<DuePair>& due) {
  times_ = &motion.times;
  for (const int body : taken_) bodies_[body].is_taken = false;
  taken_.clear();
  for (const DuePair& next : due) {
    const PairResult& pair = pairs[next.pair];
    if (pair.span.empty()) continue;
    for (const int index : {pair.body_a, pair.body_b}) {
      SweptBody& body = bodies_[index];
      if (!body.is_taken) {
        body.is_taken = true;
        body.first = pair.span.first;
        body.last = pair.span.last;
        taken_.push_back(index);
      }
      body.first = std::min(body.first, pair.span.first);
      body.last = std::max(body.last, pair.span.last);
    }
  }
  for (const int body : taken_) {
    const bool known = scene_.bodies[body].failure.empty() && (motion.missing.empty() || motion.missing[body].empty());
    if (known) sweep(motion, body);
  }
}

void SweptBodies::sweep(const CycleMotion& motion, int body) {
  SweptBody& swept = bodies_[body];
  const std::size_t last = motion.X_WB[body].size() == 1 ? swept.first + 1 : swept.last;
  swept.intervals.clear();
  swept.problem.clear();
  swept.defect = swept.rounding = swept.moved = 0.0;
  try {
    for (std::size_t k = swept.first; k < last; ++k) {
      const Isometry3d &X_WB_start = motion.pose(body, k), &X_WB_end = motion.pose(body, k + 1);
      requireNear(scene_.bodies[body].name, X_WB_start);
      requireNear(scene_.bodies[body].name, X_WB_end);
      const ScrewMotion screw(X_WB_start, X_WB_end);
      swept.moved = std::max(swept.moved, (X_WB_end.translation() - X_WB_start.translation()).norm());
      swept.intervals.push_back({screw, worldTwist(screw, scene_.bodies[body].ball)});
    }
    for (std::size_t k = swept.first; k <= last; ++k) {
      swept.defect = std::max(swept.defect, poseDefect(motion.pose(body, k)));
      swept.rounding = std::max(swept.rounding, poseRounding(motion.pose(body, k)));
    }
  } catch (const std::exception& error) {
    swept.problem = error.what();
  }
}

}  // namespace sdf_ccd
