#include "proof_watch.h"

#include <algorithm>
#include <cmath>

#include "geometry_extent.h"
#include "motion/two_body_motion.h"

namespace sdf_ccd {
namespace {

bool areKnown(const UnreachablePair& pair, const CycleMotion& motion) {
  const auto isKnown = [&](int body) { return motion.missing.empty() || motion.missing[body].empty(); };
  return isKnown(pair.body_a) && isKnown(pair.body_b);
}

double errorOf(const CycleMotion& motion, std::size_t body) {
  return motion.motion_error.empty() ? 0.0 : motion.motion_error[body];
}

double distanceFromOrigin(const Vector3d& start, const Vector3d& end) {
  const Vector3d d = end - start;
  const double s = -start.dot(d) / d.squaredNorm();
  return (start + std::min(1.0, std::max(0.0, s)) * d).norm();  // NaN, of equal points, becomes 0
}

/// Whether a point on a segment is found that may be this near to the geometry.
bool comesWithin(double distance, const std::vector<GeometryDescription>& geometry, const Vector3d& start,
                 const Vector3d& end, int halvings = 8) {
  const double at_start = distanceBelow(geometry, start), at_end = distanceBelow(geometry, end);
  if (std::min(at_start, at_end) <= distance) return true;
  if (at_start + at_end - (end - start).norm() > 2.0 * distance || halvings == 0) return false;
  const Vector3d middle = 0.5 * (start + end);
  return comesWithin(distance, geometry, start, middle, halvings - 1) ||
         comesWithin(distance, geometry, middle, end, halvings - 1);
}

}  // namespace

std::string contradictionOf(const UnreachablePair& pair) {
  return (pair.X_AB ? std::string(kRigidlyJoined) + " in the URDF, but not in tf"
                    : std::string(kOutOfReach) + " according to the URDF, but close to each other in tf") +
         ": do the URDF and tf belong to the same robot? If these may touch, name them in allowed_pairs";
}

/// How a curve between two waypoints differs from its chord: by no more than an eighth of the acceleration.
struct ProofWatch::Step {
  const CycleMotion& motion;
  std::size_t to;

  ScrewMotion screw(const Watched& of) const { return {motion.pose(of.body, to - 1), motion.pose(of.body, to)}; }

  double deviation(const Watched& a, const Watched& b) const {
    const auto acceleration = [&](const Watched& of) { return screw(of).maxAcceleration({of.ball.center, 0.0}); };
    return 0.125 * (acceleration(a) + acceleration(b)) + errorOf(motion, a.body) + errorOf(motion, b.body);
  }

  /// As an object's frame has the link's centre.
  double deviationIn(const Watched& object, const Watched& link) const {
    const WorldTwist F = worldTwist(screw(object), {Vector3d::Zero(), 0.0});
    const WorldTwist P = worldTwist(screw(link), {link.ball.center, 0.0});
    return 0.125 * relativeMotionBounds(F, P).acceleration + errorOf(motion, object.body) + errorOf(motion, link.body);
  }
};

ProofWatch::ProofWatch(const std::vector<UnreachablePair>& pairs, const SceneDescription& scene) {
  std::vector<int> index(scene.bodies.size(), -1);
  const auto watch = [&](int body, const BoundingBall& ball) {
    int& known = index[static_cast<std::size_t>(body)];
    if (known >= 0) return static_cast<std::size_t>(known);
    const std::size_t next = watched_.size();
    known = static_cast<int>(next);
    watched_.push_back({static_cast<std::size_t>(body), ball, next});
    const BodyDescription& description = scene.bodies[static_cast<std::size_t>(body)];
    if (description.is_world) watched_.back().boxes = inBoxes(description.geometry);
    return next;
  };
  for (const UnreachablePair& pair : pairs) {
    const bool is_joined = pair.X_AB.has_value();
    pairs_.push_back({watch(pair.body_a, pair.ball_a), watch(pair.body_b, pair.ball_b),
                      pair.ball_a.radius + pair.ball_b.radius, is_joined, &pair});
    if (is_joined) join(pairs_.back());
    (is_joined ? any_joined_ : any_apart_) = true;
  }
  for (const Watched& body : watched_) {
    const double size = (body.X_GB * body.ball.center).norm() + body.ball.radius;
    if (std::isfinite(size)) size_ = std::max(size_, size);
  }
}

void ProofWatch::join(const Pair& pair) {
  const Watched a = watched_[pair.a], b = watched_[pair.b];
  if (a.group == b.group) return;
  const Isometry3d X_GH = a.X_GB * *pair.pair->X_AB * b.X_GB.inverse();  // of B's group in A's
  for (Watched& body : watched_) {
    if (body.group != b.group) continue;
    body.group = a.group;
    body.X_GB = X_GH * body.X_GB;
  }
}

const std::vector<char>& ProofWatch::contradicted(const CycleMotion& motion, const std::vector<WaypointSpan>& spans) {
  contradicted_.assign(pairs_.size(), 0);
  if (pairs_.empty()) return contradicted_;
  if (any_apart_) place(motion, 0);
  for (std::size_t k = 1; k < motion.times.size(); ++k) {
    if (any_apart_) place(motion, k);
    const bool are_joined = !any_joined_ || areAllJoined(motion, k);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
      const Pair& pair = pairs_[p];
      if (pair.is_joined ? are_joined : areFarApart(pair)) continue;  // nearly always
      if (k <= spans[p].first || k > spans[p].last || contradicted_[p]) continue;
      if (!areKnown(*pair.pair, motion)) continue;
      if (!pair.is_joined) {
        contradicted_[p] = mayMeet(pair, motion, k);
      } else {
        const std::size_t a = watched_[pair.a].body, b = watched_[pair.b].body;
        contradicted_[p] = !areJoinedAt(*pair.pair, relativePose(motion.pose(a, k), motion.pose(b, k)));
      }
    }
  }
  return contradicted_;
}

void ProofWatch::place(const CycleMotion& motion, std::size_t waypoint) {
  for (Watched& body : watched_) {
    body.p_W_before = body.p_W;
    body.p_W = motion.pose(body.body, waypoint) * body.ball.center;
    body.travel = (body.p_W - body.p_W_before).norm();
  }
}

/// Whether all bodies are so closely where their groups have them that no pair of them need be looked at.
bool ProofWatch::areAllJoined(const CycleMotion& motion, std::size_t waypoint) const {
  constexpr double kMoved = 1e-4;  // [m]; far below that of areJoinedAt()
  return std::all_of(watched_.begin(), watched_.end(), [&](const Watched& body) {
    if (&watched_[body.group] == &body) return true;
    const std::size_t group = watched_[body.group].body;
    const Isometry3d X_GB = relativePose(motion.pose(group, waypoint), motion.pose(body.body, waypoint));
    return (X_GB.translation() - body.X_GB.translation()).squaredNorm() <= kMoved * kMoved &&
           (X_GB.linear() - body.X_GB.linear()).squaredNorm() * size_ * size_ <= kMoved * kMoved;
  });
}

/// Whether two bodies are beyond each other's reach at a waypoint by more than they have moved to there. Saves most
/// pairs the roots and divisions of mayMeet().
bool ProofWatch::areFarApart(const Pair& pair) const {
  const Watched &a = watched_[pair.a], &b = watched_[pair.b];
  const double near = pair.reach + a.travel + b.travel;
  return (b.p_W - a.p_W).squaredNorm() > near * near;
}

/// Whether two bodies come nearer to each other than the URDF's joints allow, on the way to a waypoint or there.
bool ProofWatch::mayMeet(const Pair& pair, const CycleMotion& motion, std::size_t waypoint) const {
  const Watched &a = watched_[pair.a], &b = watched_[pair.b];
  const Vector3d d = b.p_W - a.p_W;
  const double distance = distanceFromOrigin(b.p_W_before - a.p_W_before, d);
  if (distance > pair.reach) return false;
  const Step step{motion, waypoint};
  if (d.norm() > pair.reach && distance + step.deviation(a, b) > pair.reach) return false;
  // An object may be out of reach though the balls meet, as that of a floor is wide.
  return !isApart(a, b, step) && !isApart(b, a, step);
}

bool ProofWatch::isApart(const Watched& object, const Watched& link, const Step& step) const {
  if (object.boxes.empty()) return false;
  const auto in = [&](const Vector3d& p_W, std::size_t waypoint) {
    return Vector3d(step.motion.pose(object.body, waypoint).inverse() * p_W);
  };
  const Vector3d start = in(link.p_W_before, step.to - 1), end = in(link.p_W, step.to);
  const double radius = link.ball.radius;
  if (!comesWithin(radius, object.boxes, start, end)) return true;
  return distanceBelow(object.boxes, end) > radius &&
         !comesWithin(radius - step.deviationIn(object, link), object.boxes, start, end);
}

}  // namespace sdf_ccd
