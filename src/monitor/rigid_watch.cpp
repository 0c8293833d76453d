#include "rigid_watch.h"

#include <algorithm>
#include <cmath>

#include "motion/two_body_motion.h"

namespace sdf_ccd {
namespace {

bool isKnown(const CycleMotion& motion, std::size_t body) {
  return !motion.X_WB[body].empty() && (motion.missing.empty() || motion.missing[body].empty());
}

}  // namespace

RigidWatch::RigidWatch(const Scene& scene) {
  std::vector<int> index(scene.bodies.size(), -1);
  const auto watch = [&](int body, const BoundingBall& ball) {
    int& known = index[static_cast<std::size_t>(body)];
    if (known < 0) {
      known = static_cast<int>(watched_.size());
      watched_.push_back({static_cast<std::size_t>(body), ball, watched_.size()});
    }
    return static_cast<std::size_t>(known);
  };
  for (const PairDecision& pair : scene.left_out) {
    if (!pair.rigid) continue;
    pairs_.push_back({pair.a, pair.b, false, false});
    joints_.push_back({watch(pair.a, pair.rigid->ball_a), watch(pair.b, pair.rigid->ball_b), pair.rigid->X_AB});
    join(joints_.back());
  }
  for (const Watched& body : watched_) {
    const double size = (body.X_GB * body.ball.center).norm() + body.ball.radius;
    size_ = std::max(size_, std::isfinite(size) ? size : kHalfSpaceRadius);
  }
}

void RigidWatch::join(const Joint& joint) {
  const Watched a = watched_[joint.a], b = watched_[joint.b];
  if (a.group == b.group) return;
  const Isometry3d X_GH = a.X_GB * joint.X_AB * b.X_GB.inverse();  // of B's group in A's
  for (Watched& body : watched_) {
    if (body.group != b.group) continue;
    body.group = a.group;
    body.X_GB = X_GH * body.X_GB;
  }
}

void RigidWatch::find(const CycleMotion& motion, const std::vector<WaypointSpan>& spans,
                      std::vector<char>& moved) const {
  for (std::size_t k = 0; k < motion.times.size(); ++k) {
    if (areAllJoined(motion, k)) continue;
    for (std::size_t p = 0; p < joints_.size(); ++p) {
      const bool is_within = spans.empty() || (spans[p].first <= k && k <= spans[p].last && !spans[p].empty());
      if (is_within && !moved[p]) moved[p] = !isJoined(joints_[p], motion, k);
    }
  }
}

/// Whether all bodies are so closely where their groups have them that no pair needs to be compared.
bool RigidWatch::areAllJoined(const CycleMotion& motion, std::size_t waypoint) const {
  constexpr double kMoved = 1e-4;  // [m]; far below that of isJoined()
  return std::all_of(watched_.begin(), watched_.end(), [&](const Watched& body) {
    const std::size_t group = watched_[body.group].body;
    if (group == body.body || !isKnown(motion, body.body)) return true;
    if (!isKnown(motion, group)) return false;
    const Isometry3d X_GB = relativePose(motion.pose(group, waypoint), motion.pose(body.body, waypoint));
    return (X_GB.translation() - body.X_GB.translation()).squaredNorm() <= kMoved * kMoved &&
           (X_GB.linear() - body.X_GB.linear()).squaredNorm() * size_ * size_ <= kMoved * kMoved;
  });
}

/// Or not known.
bool RigidWatch::isJoined(const Joint& joint, const CycleMotion& motion, std::size_t waypoint) const {
  constexpr double kMoved = 1e-3;  // [m]
  const Watched &a = watched_[joint.a], &b = watched_[joint.b];
  if (!isKnown(motion, a.body) || !isKnown(motion, b.body)) return true;
  const Isometry3d X_AB = relativePose(motion.pose(a.body, waypoint), motion.pose(b.body, waypoint));
  // Where they meet, both have points.
  return maxDisplacement(joint.X_AB, X_AB, b.ball) <= kMoved ||
         maxDisplacement(joint.X_AB.inverse(), X_AB.inverse(), a.ball) <= kMoved;
}

}  // namespace sdf_ccd
