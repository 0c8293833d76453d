#include "pair_depth.h"

#include <algorithm>
#include <cmath>

#include "motion/time_at.h"
#include "scene/body_triangles.h"

namespace sdf_ccd {
namespace {

constexpr int kMaxPieces = 20000;  // takes some tens of milliseconds
constexpr int kFewPieces = 2000;   // mostly suffice for a surface of which nothing is known

/// Null if the body has none that is certain.
std::shared_ptr<const DepthSolid> solidOf(const Body& body) {
  if (body.half_spaces.empty()) return body.triangles && !body.inside_is_doubtful ? body.solid : nullptr;
  if (body.half_spaces.size() > 1 || body.triangles) return nullptr;
  return std::make_shared<const DepthSolid>(body.half_spaces.front().half_space);
}

}  // namespace

bool PairDepth::isPossible(const Body& a, const Body& b) {
  return solidOf(a) && solidOf(b) && (a.triangles || b.triangles);
}

PairDepth::PairDepth(const Body& a, const Body& b, double resolution) {
  const bool a_is_larger = a.ball.radius > b.ball.radius;  // in the same order whichever of them is A
  addDirection(a_is_larger ? a : b, a_is_larger ? b : a, a_is_larger, resolution);
  addDirection(a_is_larger ? b : a, a_is_larger ? a : b, !a_is_larger, resolution);
  // First the one that may be deeper: what a thin body can hold then mostly needs no search.
  std::stable_sort(directions_.begin(), directions_.end(), [](const Direction& one, const Direction& other) {
    return one.solid->greatestDepth() > other.solid->greatestDepth();
  });
}

void PairDepth::addDirection(const Body& f, const Body& p, bool f_is_a, double resolution) {
  std::shared_ptr<const DepthSolid> solid = solidOf(f);
  deviation_ += solid->deviation();
  if (!f.half_spaces.empty()) deviation_ += f.half_spaces.front().deviation;
  if (!p.triangles) return;
  deviation_ += p.triangles->deviation;
  const DepthSolid& in = *solid;
  directions_.push_back({f_is_a, std::move(solid), RelativeMotion(f, p, f_is_a),
                         DepthSearch(p.triangles->tree, in, resolution), std::nullopt});
}

void PairDepth::forget() {
  known_.reset();
  restart();
}

void PairDepth::restart() {
  for (Direction& direction : directions_) {
    direction.search.restart();
    direction.X_FP.reset();
  }
}

/// Measures a point of a surface at a time. @return its depth [m].
double PairDepth::offer(const Place& place, std::size_t step, double s) {
  const Direction& direction = directions_[place.direction];
  const DeepestPoint point = direction.search.pointAt(place.p_P, direction.motion.motion(step), s);
  if (point.depth > best_.depth) {
    best_ = point;
    best_direction_ = place.direction;
    best_step_ = step;
  }
  return point.depth;
}

/// Searches over a part of the motion. @return upper bound of the depth of any point, if more than the deepest found
/// [m].
double PairDepth::search(const Interval& times) {
  int left = kMaxPieces;
  const std::size_t steps = directions_.front().motion.steps();
  for (std::size_t step = 0; step < steps; ++step) {
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      // Nothing is known of a surface without a search. The first step needs the most.
      const int even = left / static_cast<int>((steps - step) * directions_.size() - i);
      const int share = std::max(even, std::min(left, kFewPieces));
      int pieces = share;
      Direction& direction = directions_[i];
      const TwoBodyMotion whole = direction.motion.motion(step);
      const double length = whole.t_end - whole.t_start;
      const double start = std::max(0.0, (times.enter - whole.t_start) / length),
                   end = std::min(1.0, (times.exit - whole.t_start) / length);
      if (!(start <= end)) continue;
      const double travel = direction.motion.bounds(step).travel;
      const double depth = best_.depth;
      const auto run = [&](const TwoBodyMotion& motion) { direction.search.run(motion, travel, best_, pieces); };
      if (start == 0.0 && end == 1.0) {
        run(whole);
      } else {
        withPart(whole, start, end, run);
        if (best_.depth > depth) best_.s = start + (end - start) * best_.s;
      }
      left -= share - pieces;
      if (!(best_.depth > depth)) continue;
      best_direction_ = i;
      best_step_ = step;
    }
  }
  double highest = 0.0;
  for (const Direction& direction : directions_) highest = std::max(highest, direction.search.highest());
  return highest;
}

/// As found by search().
ContactPoint PairDepth::deepestPoint(double highest, double error) const {
  ContactPoint point;
  point.depth = best_.depth;
  point.depth_error = std::max(0.0, highest - best_.depth) + error + deviation_;
  if (!(best_.depth > 0.0)) return point;
  const Direction& direction = directions_[best_direction_];
  point.depth_error += best_.depth - std::max(0.0, direction.solid->leastDepth(best_.p_G, best_.depth));
  const TwoBodyMotion motion = direction.motion.motion(best_step_);
  const Isometry3d X_WG = motion.X_WF.pose(best_.s) * direction.solid->X_BG();
  point.time = timeAt(motion, best_.s);
  point.p_W = X_WG * best_.p_G;
  // Outward from the solid: this is from A to B if the solid is A.
  point.normal_W = (direction.f_is_a ? 1.0 : -1.0) * (X_WG.linear() * best_.out_G);
  return point;
}

PairDepth::Found PairDepth::run(const PairMotion& pair, double error, Memory& memory) {
  constexpr std::size_t kMostTimes = 16;  // at which the point known is measured first
  best_ = {};
  for (std::size_t i = 0; i < directions_.size(); ++i) {
    Direction& direction = directions_[i];
    direction.motion.set(pair, memory[i]);
    const Isometry3d& start = direction.motion.start();
    double displacement = kInfinity;
    if (direction.X_FP)
      displacement = direction.X_FP->matrix() == start.matrix() ? 0.0 : direction.motion.jumpFrom(*direction.X_FP);
    direction.search.begin(displacement);
    direction.X_FP.reset();  // until the search ends
  }
  const std::size_t steps = directions_.front().motion.steps();
  if (known_) {
    offer(*known_, 0, 0.0);
    const std::size_t stride = (steps - 1) / kMostTimes + 1;
    for (std::size_t step = 0; step < steps; step += stride) offer(*known_, std::min(step + stride, steps) - 1, 1.0);
  }
  const double highest = search({-kInfinity, kInfinity});
  for (Direction& direction : directions_) direction.X_FP = direction.motion.end();
  Found found{deepestPoint(highest, error), error + deviation_};
  known_.reset();
  if (!(best_.depth > 0.0)) return found;
  known_ = Place{best_direction_, best_.p_P};
  // Depth changes by no more than the point moves.
  const double at_start = offer(*known_, 0, 0.0), at_end = offer(*known_, steps - 1, 1.0);
  found.throughout = std::min(at_start, at_end) - 0.5 * directions_[known_->direction].motion.travel();
  return found;
}

ContactPoint PairDepth::deepestWithin(const Interval& times, double error) {
  restart();
  for (Direction& direction : directions_) direction.search.begin(kInfinity);
  best_ = {};
  const ContactPoint point = deepestPoint(search(times), error);
  restart();
  return point;
}

double PairDepth::depthAt(double time) const {
  if (!known_) return 0.0;
  const Direction& direction = directions_[known_->direction];
  const auto [step, s] = direction.motion.stepAt(time);
  return direction.search.pointAt(known_->p_P, direction.motion.motion(step), s).depth;
}

}  // namespace sdf_ccd
