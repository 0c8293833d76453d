#include "contact_refinement.h"

#include <algorithm>
#include <cmath>

#include "motion/time_at.h"
#include "pair_cycle.h"
#include "pair_result.h"
#include "query/smooth_pieces.h"
#include "scene/pair_bound.h"
#include "scene/union_depth.h"

namespace sdf_ccd {
namespace {

constexpr int kMaxPieces = 20000;  // takes some tens of milliseconds

bool canBeMeasured(const Body& body) {
  return !body.half_spaces.empty() || (body.triangles && !body.triangles->solids.empty());
}

/// Empty if no pair needs the body's fields.
std::vector<SolidPart> partsOf(const Body& body) {
  std::vector<SolidPart> parts;
  for (std::size_t i = 0; i < body.parts.size(); ++i)
    parts.push_back({body.parts[i].X_BG.inverse(), &body.parts[i].field,
                     body.triangles ? body.triangles->solids[i].get() : nullptr});
  return parts;
}

/// Upper bound of the relative displacement of the bodies' points between two times [m].
double travelBetween(const RelativeMotion& motion, double from, double to) {
  double travel = 0.0;
  for (std::size_t step = 0; step < motion.steps(); ++step) {
    const TwoBodyMotion along = motion.motion(step);
    const double share = (std::min(to, along.t_end) - std::max(from, along.t_start)) / (along.t_end - along.t_start);
    // A step's bound is for the whole step, and no part of it is more than twice as fast (see relativeMotionBounds()).
    if (share > 0.0) travel += std::min(1.0, 2.0 * share) * motion.bounds(step).travel;
  }
  return travel;
}

}  // namespace

bool ContactRefinement::isPossible(const Body& a, const Body& b) {
  return canBeMeasured(a) && canBeMeasured(b) && !(a.parts.empty() && b.parts.empty());
}

ContactRefinement::ContactRefinement(const Body& a, const Body& b, double resolution)
    : a_(&a), b_(&b), resolution_(resolution) {
  const auto add = [&](const Body& solid, const Body& surface) {
    if (!solid.parts.empty() && surface.triangles)
      directions_.push_back({&solid, &surface, {&surface.triangles->tree, partsOf(surface)}, partsOf(solid)});
  };
  add(b, a);
  add(a, b);
}

void ContactRefinement::run(const PairCycle& cycle, SurfacePair& surfaces, PairResult& result) const {
  const double motion_error = result.error.chord;
  if (const std::optional<Interval> touch = surfaces.firstTouch(motion_error, cycle.memory.separation))
    setBegin(*touch, surfaces, result);
  findDeepest(cycle.bodies, motion_error + surfaces.deviation(), cycle.memory.refinement, result);
  result.refined = true;
}

/// Contact begins where the surfaces first touch, unless a body is inside the other then.
void ContactRefinement::setBegin(const Interval& touch, const SurfacePair& surfaces, PairResult& result) const {
  const RelativeMotion& motion = surfaces.motion();
  std::vector<Interval>& intervals = result.intervals;
  if (touch.enter == motion.motion(0).t_start || surfaces.containment(motion.start()).excluded) {
    result.first_touch = touch;
    const auto isBefore = [&](const Interval& interval) { return interval.exit < touch.enter; };
    intervals.erase(std::remove_if(intervals.begin(), intervals.end(), isBefore), intervals.end());
    if (intervals.empty()) intervals.push_back({touch.enter, touch.enter});
    intervals.front().enter = std::max(intervals.front().enter, touch.enter);
    const auto isTooEarly = [&](const ContactPoint& point) { return point.exit < touch.enter; };
    for (std::vector<ContactPoint>* points : {&result.points, &result.peaks})
      points->erase(std::remove_if(points->begin(), points->end(), isTooEarly), points->end());
    result.deepest.time = std::max(result.deepest.time, intervals.front().enter);
  }
  if (!(touch.exit < intervals.front().enter)) return;
  // The contact continues until the first interval of the shells, if the bodies cannot separate meanwhile by more than
  // the error of the shells.
  const bool goes_on = travelBetween(motion, touch.exit, intervals.front().enter) <= result.contact_error.total();
  intervals.insert(intervals.begin(), {touch.exit, goes_on ? intervals.front().enter : touch.exit});
  mergeIntervals(intervals, 0.0);
}

/// Upper bound of the depth, during the step, of points of body p where parts of body f meet [m]; 0 if there are none.
/// @param depth  of points in single parts, at most [m].
double ContactRefinement::depthAtSeams(const StepMotion& step, double depth) const {
  const Body& solid = *step.f;
  const std::vector<BodyPart>& parts = solid.parts;
  const BoundingBall& ball = step.p->ball;
  const Vector3d center_F = step.motion.X_FP(0.5) * ball.center;
  const double reach = ball.radius + step.travel;
  const auto isNear = [&](const BodyPart& part) {
    return part.field.lowerBound(part.X_BG.inverse() * center_F) <= reach + depth;
  };
  const auto boxOf = [&](const BodyPart& part) {
    const PartExtent extent = extentOf(part.X_BG, part.field);
    AlignedBox3d box;
    for (int axis = 0; axis < 3; ++axis) {
      box.min()[axis] = -extent.farthest(-Vector3d::Unit(axis), false) - depth;
      box.max()[axis] = extent.farthest(Vector3d::Unit(axis), false) + depth;
    }
    return box;
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (!isNear(parts[i])) continue;
    const AlignedBox3d box = boxOf(parts[i]);
    for (std::size_t k = i + 1; k < parts.size(); ++k) {
      if (!isNear(parts[k])) continue;
      const AlignedBox3d both = box.intersection(boxOf(parts[k]));
      if (both.isEmpty() || both.exteriorDistance(center_F) > reach) continue;
      const auto extent = [&](std::size_t part) { return extentOf(parts[part].X_BG, parts[part].field); };
      return std::min(greatestDepth(solid), boundOfUnionDepth(parts.size(), extent, center_F) + reach);
    }
  }
  return 0.0;
}

/// @param error  of positions, without that of the search [m].
void ContactRefinement::findDeepest(const SweptBodies& bodies, double error, Memory& memory, PairResult& result) const {
  DeepestSearch& search = memory.search;
  search.restart(resolution_);
  std::vector<StepMotion>& motions = memory.motions;
  motions.clear();
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    const Direction& direction = directions_[i];
    RelativeMotion relative(*direction.f, *direction.p, direction.f == a_);
    relative.set({bodies, result.body_a, result.body_b, result.span}, memory.bounds[i]);
    for (std::size_t step = 0; step < relative.steps(); ++step) {
      const TwoBodyMotion motion = relative.motion(step);
      search.add(direction.surface, direction.solid, motion, relative.bounds(step).travel);
      motions.push_back({direction.f, direction.p, motion, relative.bounds(step).travel});
    }
  }
  search.run(kMaxPieces);
  ContactPoint point = result.deepest;
  if (search.found()) {
    const DeepestPoint& found = search.deepest();
    const TwoBodyMotion& motion = motions[found.motion].motion;
    const Isometry3d X_WF = motion.X_WF.pose(found.s);
    point.time = timeAt(motion, found.s);
    point.p_W = X_WF * found.p_F;
    // Outward from the solid: this is from A to B if the solid is A.
    point.normal_W = (motions[found.motion].f == a_ ? 1.0 : -1.0) * (X_WF.linear() * found.out_F);
  }
  point.depth = search.deepest().depth;
  point.depth_error = search.error() + error;
  // Without its fields, a body's inside is not searched for the other's surface; of a half-space's that does not count.
  const bool counts = a_->triangles && b_->triangles;
  for (const Body* body : {a_, b_})
    if (counts && body->parts.empty())
      point.depth_error = std::max(point.depth_error, greatestDepth(*body) + error - point.depth);
  // The search measures the depth in one part. Where parts meet, the body is deeper than that.
  const double in_part = point.depth + point.depth_error;
  for (const StepMotion& step : motions)
    point.depth_error = std::max(point.depth_error, depthAtSeams(step, in_part) + error - point.depth);
  setTimes(result.intervals, point);
  if (point.depth > error) result.verdict = Verdict::kContact;
  result.deepest = point;
}

}  // namespace sdf_ccd
