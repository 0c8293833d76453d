#include "sdf_ccd/distances.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "monitor/pose_rounding.h"
#include "motion/two_body_motion.h"
#include "scene/body_triangles.h"
#include "scene/pair_bound.h"
#include "sdf_ccd/monitor.h"
#include "surface/moving_boxes.h"
#include "surface/plane_separation.h"
#include "surface/separation.h"
#include "surface/surface_distance.h"

namespace sdf_ccd {
namespace {

/// Bound of the error of a distance between triangles, beyond triangleRounding(), relative to the size of the bodies:
/// see surfaceDistance().
constexpr double kTriangleError = 1e-7;

constexpr double kSameTime = 1e-8;  // some times the rounding of time stamps [s]

/// Whether the result has the bodies touching at the end of the span.
bool touchesAtEnd(const PairResult& pair, double end) {
  constexpr double kJoin = std::chrono::duration<double>(ContactTracker::kJoin).count();
  return pair.verdict == Verdict::kContact && !pair.intervals.empty() && pair.intervals.back().exit + kJoin >= end;
}

/// Upper bound of the displacement of the ball's points along −n, from one pose to the next; n in F.
double closingAlong(const Vector3d& n_F, const Isometry3d& X_from, const Isometry3d& X_to, const BoundingBall& ball) {
  const double middle = -n_F.dot(X_to * ball.center - X_from * ball.center);
  return middle + ball.radius * ((X_to.linear() - X_from.linear()).transpose() * n_F).norm();
}

}  // namespace

struct PairDistances::Impl {
  explicit Impl(std::shared_ptr<const Scene> scene) : scene_(std::move(scene)), pairs_(scene_->pairs.size()) {}

  const std::vector<PairDistance>& update(const CycleMotion& motion, const CycleResult& result, double range,
                                          const CycleRecord& record);
  void forget();
  void continueFrom(Impl& before, const std::vector<int>& pairs_now);

  static constexpr double kNotMeasured = -1.0;  // below any range

  /// The last measurement of two surfaces of triangles, for bodies that do not move relative to each other.
  struct SurfaceMeasurement {
    Isometry3d X_AB = Isometry3d::Identity();
    double limit = kNotMeasured;             // farther surfaces were not measured [m]
    std::optional<SurfaceDistance> nearest;  // none: farther than the limit
    std::optional<double> slab;
  };

  struct Pair {
    double known_within = kNotMeasured;  // range of the last measurement [m]; kNotMeasured: not measured
    SeparationWitness witness;
    SurfaceMeasurement surfaces;
    PairDistance last;  // valid if is_near
    bool is_near = false;
  };

  void measure(std::size_t pair, const CycleMotion& motion, const PairResult& result, double range,
               const CycleRecord& record);
  bool findNearest(std::size_t pair, const Isometry3d& X_WA, const Isometry3d& X_WB, double range, PairDistance& found);
  bool nearestOfSurfaces(std::size_t pair, const Isometry3d& X_WA, const Isometry3d& X_WB, double range,
                         PairDistance& found);
  double measureSurfaces(std::size_t pair, const Isometry3d& X_AB, double limit);
  bool isOneInside(const PairDistance& found, const Isometry3d& X_WA, const Isometry3d& X_WB) const;
  bool nearestOfPlane(std::size_t pair, bool plane_is_a, const BodyHalfSpace& plane, const Isometry3d& X_WF,
                      const Isometry3d& X_WP, double range, PairDistance& found);

  /// Motion of P relative to F from the waypoint before `last` to `last`.
  struct Step {
    bool f_is_a;
    Isometry3d X_then, X_now;
    const BoundingBall& ball;  // of P
  };
  Step stepOf(const CycleMotion& motion, std::size_t last, int body_a, int body_b) const;
  double travelSince(double time, const CycleMotion& motion, const PairResult& result) const;
  void setSpeeds(const CycleMotion& motion, const WaypointSpan& span, const CycleRecord& record,
                 PairDistance& found) const;

  std::shared_ptr<const Scene> scene_;
  std::vector<Pair> pairs_;
  std::vector<PairDistance> near_;
  std::chrono::nanoseconds origin_{0};  // of the last cycle
  bool has_unknown_ = false;
  bool is_empty_ = true;  // nothing is stored
  SeparationMemory memory_;
};

PairDistances::PairDistances(std::shared_ptr<const Scene> scene) : impl_(std::make_unique<Impl>(std::move(scene))) {}
PairDistances::~PairDistances() = default;

const std::vector<PairDistance>& PairDistances::update(const CycleMotion& motion, const CycleResult& result,
                                                       double range, const CycleRecord& record) {
  return impl_->update(motion, result, range, record);
}

const std::vector<PairDistance>& PairDistances::near() const {
  return impl_->near_;
}

bool PairDistances::hasUnknown() const {
  return impl_->has_unknown_;
}

void PairDistances::forget() {
  impl_->forget();
}

void PairDistances::continueFrom(PairDistances& before, const std::vector<int>& pairs_now) {
  impl_->continueFrom(*before.impl_, pairs_now);
}

void PairDistances::Impl::forget() {
  if (is_empty_) return;
  for (Pair& pair : pairs_) {
    pair.is_near = false;
    pair.known_within = kNotMeasured;
  }
  near_.clear();
  is_empty_ = true;
}

void PairDistances::Impl::continueFrom(Impl& before, const std::vector<int>& pairs_now) {
  near_.swap(before.near_);
  const auto isGone = [&](const PairDistance& near) { return pairs_now[near.pair] < 0; };
  near_.erase(std::remove_if(near_.begin(), near_.end(), isGone), near_.end());
  for (PairDistance& near : near_) {
    const int now = pairs_now[near.pair];
    pairs_[now] = std::move(before.pairs_[near.pair]);
    pairs_[now].surfaces = {};
    near.pair = now;
    near.body_a = scene_->pairs[now].body_a;
    near.body_b = scene_->pairs[now].body_b;
    pairs_[now].last = near;
  }
  for (std::size_t pair = 0; pair < pairs_now.size(); ++pair)
    if (pairs_now[pair] >= 0) pairs_[pairs_now[pair]].known_within = before.pairs_[pair].known_within;
  origin_ = before.origin_;
  is_empty_ = before.is_empty_;
}

const std::vector<PairDistance>& PairDistances::Impl::update(const CycleMotion& motion, const CycleResult& result,
                                                             double range, const CycleRecord& record) {
  const double later = std::chrono::duration<double>(record.origin - origin_).count();
  origin_ = record.origin;
  has_unknown_ = is_empty_ = false;
  near_.clear();
  for (std::size_t i = 0; i < pairs_.size(); ++i) {
    const PairResult& pair = result.pairs[i];
    Pair& known = pairs_[i];
    if (pair.span.empty()) {
      if (known.is_near) known.last.time -= later;  // times count from this cycle's start
      has_unknown_ |= !known.is_near && known.known_within < range;
    } else if (pair.verdict == Verdict::kNotChecked) {
      known.is_near = false;
      known.known_within = kNotMeasured;
    } else {
      measure(i, motion, pair, range, record);
      known.known_within = range;
    }
    if (known.is_near) near_.push_back(known.last);
  }
  return near_;
}

void PairDistances::Impl::measure(std::size_t i, const CycleMotion& motion, const PairResult& result, double range,
                                  const CycleRecord& record) {
  Pair& pair = pairs_[i];
  pair.is_near = false;
  if (result.verdict == Verdict::kClear && result.clearance > range) return;
  const Isometry3d &X_WA = motion.pose(result.body_a, result.span.last),
                   &X_WB = motion.pose(result.body_b, result.span.last);
  PairDistance found;
  found.pair = static_cast<int>(i);
  found.body_a = result.body_a;
  found.body_b = result.body_b;
  found.is_with_map = !scene_->bodies[result.body_a].map.empty() || !scene_->bodies[result.body_b].map.empty();
  found.is_constant = record.single_pose_is_fixed && !found.is_with_map && motion.X_WB[result.body_a].size() == 1 &&
                      motion.X_WB[result.body_b].size() == 1;
  found.time = motion.times[result.span.last];
  const bool touches = touchesAtEnd(result, found.time);
  const bool is_within = findNearest(i, X_WA, X_WB, range, found);
  if (touches && is_within && isOneInside(found, X_WA, X_WB)) found.distance = 0.0;
  // Bodies that touched may have separated before the end of the span. They can have moved
  // `gone` apart at most: a larger distance of the surfaces means that one body is inside the other.
  const double gone =
      touches ? result.contact_error.total() + travelSince(result.intervals.back().exit, motion, result) : 0.0;
  if (touches && !(is_within && found.distance > 0.0 && found.distance - found.error <= gone)) {
    if (!is_within || found.distance > 0.0) found.error = gone;
    found.distance = 0.0;
    found.slab.reset();
    const bool is_with_plane = !scene_->bodies[result.body_a].triangles || !scene_->bodies[result.body_b].triangles;
    if (!(is_within && is_with_plane)) {
      found.p_A_W = found.p_B_W = result.deepest.p_W;
      found.normal_W = result.deepest.normal_W;
    }
  } else {
    if (!is_within) return;
    if (result.verdict == Verdict::kClear) {
      found.error = std::min(found.error, std::max(0.0, found.distance - result.clearance));
    } else {
      found.error = std::max(found.error, found.distance);  // they may touch
    }
  }
  found.any.width = std::max(0.0, found.distance - found.error);
  setSpeeds(motion, result.span, record, found);
  pair.last = found;
  pair.is_near = true;
}

bool PairDistances::Impl::findNearest(std::size_t i, const Isometry3d& X_WA, const Isometry3d& X_WB, double range,
                                      PairDistance& found) {
  const PlannedPair& pair = scene_->pairs[i];
  const Body &a = scene_->bodies[pair.body_a], &b = scene_->bodies[pair.body_b];
  bool is_within = false;
  if (a.triangles && b.triangles) is_within = nearestOfSurfaces(i, X_WA, X_WB, range, found);
  const bool plane_is_a = !a.half_spaces.empty();
  for (const BodyHalfSpace& plane : (plane_is_a ? a : b).half_spaces) {
    PairDistance of_plane = found;
    of_plane.slab.reset();
    if (!(plane_is_a ? nearestOfPlane(i, true, plane, X_WA, X_WB, range, of_plane)
                     : nearestOfPlane(i, false, plane, X_WB, X_WA, range, of_plane)))
      continue;
    if (is_within) {
      // No slab separates the body from both.
      const double low = std::min(found.distance - found.error, of_plane.distance - of_plane.error);
      if (of_plane.distance < found.distance) std::swap(found, of_plane);
      found.error = std::max(found.error, found.distance - low);
      found.slab.reset();
    } else {
      found = of_plane;
    }
    is_within = true;
  }
  return is_within;
}

/// Whether the point of one body that is nearest to the other's surface is certainly inside the other.
bool PairDistances::Impl::isOneInside(const PairDistance& found, const Isometry3d& X_WA, const Isometry3d& X_WB) const {
  const auto contains = [&](int body, const Isometry3d& X_WO, const Vector3d& p_W) {
    const Body& outer = scene_->bodies[body];
    return outer.triangles && !outer.inside_is_doubtful && outer.triangles->isInside(X_WO.inverse() * p_W);
  };
  return contains(found.body_a, X_WA, found.p_B_W) || contains(found.body_b, X_WB, found.p_A_W);
}

/// The lowest point of a body above a half-space, and its foot on the plane.
bool PairDistances::Impl::nearestOfPlane(std::size_t i, bool plane_is_a, const BodyHalfSpace& plane,
                                         const Isometry3d& X_WF, const Isometry3d& X_WP, double range,
                                         PairDistance& found) {
  const PlannedPair& pair = scene_->pairs[i];
  const Body &body_a = scene_->bodies[pair.body_a], &body_b = scene_->bodies[pair.body_b];
  const BoxTree& surface = (plane_is_a ? body_b : body_a).triangles->tree;
  const double deviation = deviationOf(body_a, body_b) + plane.deviation;
  const Isometry3d X_FP = relativePose(X_WF, X_WP);
  const double accuracy =
      kTriangleError * surface.ball().radius + heightRounding(plane.half_space, surface, {X_FP, X_FP});
  const LowestPoint lowest = lowestPoint(plane.half_space, surface, X_FP, accuracy, pairs_[i].witness, memory_);
  const double error = deviation + accuracy + (lowest.height - lowest.at_least);
  if (!(lowest.height <= range + error)) return false;
  const Vector3d up_W = X_WF.linear() * plane.half_space.normal;
  const Vector3d on_p = X_WF * lowest.p_F, on_f = on_p - lowest.height * up_W;
  found.distance = std::max(0.0, lowest.height);
  found.error = error;
  found.p_A_W = plane_is_a ? on_f : on_p;
  found.p_B_W = plane_is_a ? on_p : on_f;
  found.normal_W = plane_is_a ? up_W : Vector3d(-up_W);
  found.slab = ClosingGap{std::max(0.0, found.distance - found.error), 0.0, 0.0};
  return true;
}

/// Measures two surfaces that may be within the limit, unless they are where they were: most links of a robot at rest.
/// @return how far B has moved relative to A since the measurement, at most [m].
double PairDistances::Impl::measureSurfaces(std::size_t i, const Isometry3d& X_AB, double limit) {
  constexpr double kStill = 1e-9;  // [m]
  const Body &body_a = scene_->bodies[scene_->pairs[i].body_a], &body_b = scene_->bodies[scene_->pairs[i].body_b];
  SurfaceMeasurement& last = pairs_[i].surfaces;
  const double moved = maxDisplacement(last.X_AB, X_AB, body_b.ball);
  if (moved <= kStill && (last.nearest || limit + moved <= last.limit)) return moved;
  const BoxTree &a = body_a.triangles->tree, &b = body_b.triangles->tree;
  const double searched = limit + kStill;
  last = {X_AB, searched, surfaceDistance(a, b, X_AB, searched, pairs_[i].witness, memory_), {}};
  if (last.nearest) last.slab = slabBetween(a, b, X_AB, *last.nearest);
  return 0.0;
}

bool PairDistances::Impl::nearestOfSurfaces(std::size_t i, const Isometry3d& X_WA, const Isometry3d& X_WB, double range,
                                            PairDistance& found) {
  const PlannedPair& pair = scene_->pairs[i];
  const Body &body_a = scene_->bodies[pair.body_a], &body_b = scene_->bodies[pair.body_b];
  const Isometry3d X_AB = relativePose(X_WA, X_WB);
  const BoxTree &a = body_a.triangles->tree, &b = body_b.triangles->tree;
  const double deviation = deviationOf(body_a, body_b);
  const double error =
      deviation + kTriangleError * (a.ball().radius + b.ball().radius) + triangleRounding(a, b, {X_AB, X_AB});
  const double moved = measureSurfaces(i, X_AB, range + error);
  const std::optional<SurfaceDistance>& nearest = pairs_[i].surfaces.nearest;
  const std::optional<double>& slab = pairs_[i].surfaces.slab;
  if (!nearest) return false;
  found.error = error + nearest->slack + moved;
  if (nearest->distance > range + found.error) return false;
  found.distance = nearest->distance;
  found.p_A_W = X_WA * nearest->p_A;
  found.p_B_W = X_WA * nearest->q_A;
  const Vector3d displacement = X_WA.linear() * (nearest->q_A - nearest->p_A);
  if (nearest->distance > 0.0) found.normal_W = displacement / nearest->distance;
  if (slab && *slab - moved > deviation) found.slab = ClosingGap{*slab - moved - deviation, 0.0, 0.0};
  return true;
}

/// Motion over the last step. P is the body whose ball contains it: the ball of a half-space does not.
PairDistances::Impl::Step PairDistances::Impl::stepOf(const CycleMotion& motion, std::size_t last, int body_a,
                                                      int body_b) const {
  const bool f_is_a = scene_->bodies[body_b].half_spaces.empty();
  const int f = f_is_a ? body_a : body_b, p = f_is_a ? body_b : body_a;
  const auto X_FP = [&](std::size_t k) { return relativePose(motion.pose(f, k), motion.pose(p, k)); };
  return {f_is_a, X_FP(last - 1), X_FP(last), scene_->bodies[p].ball};
}

/// Upper bound of how far the bodies separate between a time and the end of the span [m].
double PairDistances::Impl::travelSince(double time, const CycleMotion& motion, const PairResult& result) const {
  double travel = 0.0;
  for (std::size_t last = result.span.last; last > result.span.first && motion.times[last] > time; --last) {
    const Step step = stepOf(motion, last, result.body_a, result.body_b);
    travel += maxDisplacement(step.X_then, step.X_now, step.ball);
  }
  return travel;
}

/// Mean speeds over the last step.
void PairDistances::Impl::setSpeeds(const CycleMotion& motion, const WaypointSpan& span, const CycleRecord& record,
                                    PairDistance& found) const {
  const double over = motion.times[span.last] - motion.times[span.last - 1];
  const Isometry3d &X_WA_then = motion.pose(found.body_a, span.last - 1),
                   &X_WB_then = motion.pose(found.body_b, span.last - 1),
                   &X_WA_now = motion.pose(found.body_a, span.last), &X_WB_now = motion.pose(found.body_b, span.last);
  const Vector3d p_then = X_WA_then * (X_WA_now.inverse() * found.p_A_W),
                 q_then = X_WB_then * (X_WB_now.inverse() * found.p_B_W);
  found.closing_speed = ((found.p_A_W - p_then) - (found.p_B_W - q_then)).dot(found.normal_W) / over;

  const auto [f_is_a, X_then, X_now, ball] = stepOf(motion, span.last, found.body_a, found.body_b);
  found.any.closing = maxDisplacement(X_then, X_now, ball) / over;
  // Poses between recorded ones are interpolated, so the mean speed is one over the whole time between recorded poses:
  // for each body over its own interval. If that is not this step, the errors of both bodies add up.
  found.any.over = over;
  if (record.gaps) {
    const double a = (*record.gaps)[found.body_a], b = (*record.gaps)[found.body_b];
    if (std::max(a, b) > over + kSameTime) found.any.over = std::max(over, a + b);
  }
  if (!found.slab) return;
  const Vector3d away_F = f_is_a ? Vector3d(X_WA_now.linear().transpose() * found.normal_W)
                                 : Vector3d(X_WB_now.linear().transpose() * -found.normal_W);
  found.slab->closing = closingAlong(away_F, X_then, X_now, ball) / over;
  found.slab->over = found.any.over;
}

}  // namespace sdf_ccd
