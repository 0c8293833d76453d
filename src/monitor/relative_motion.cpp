#include "relative_motion.h"

#include <algorithm>

#include "pose_rounding.h"

namespace sdf_ccd {

RelativeMotion::RelativeMotion(const Body& f, const Body& p, bool f_is_a)
    : ball_(&p.ball), is_f_in_ball_(f.half_spaces.empty()), f_is_a_(f_is_a) {}

void RelativeMotion::set(const PairMotion& pair, std::vector<RelativeMotionBounds>& bounds) {
  const SweptBodies& bodies = pair.bodies;
  const WaypointSpan& span = pair.span;
  f_ = f_is_a_ ? pair.body_a : pair.body_b;
  p_ = f_is_a_ ? pair.body_b : pair.body_a;
  bodies_ = &bodies;
  span_ = span;
  bounds_ = &bounds;
  X_FP_start_ = relativePose(bodies.screw(f_, span.first).start(), bodies.screw(p_, span.first).start());
  X_FP_end_ = relativePose(bodies.screw(f_, span.last - 1).end(), bodies.screw(p_, span.last - 1).end());
  bounds.clear();
  travel_ = 0.0;
  for (std::size_t k = span.first; k < span.last; ++k) {
    bounds.push_back(relativeMotionBounds(bodies.twist(f_, k), bodies.twist(p_, k)));
    travel_ += bounds.back().travel;
  }
  pose_error_ = bodies.poseError(p_, ball_->center.norm() + ball_->radius) + bodies.poseError(f_, reach());
}

TwoBodyMotion RelativeMotion::motion(std::size_t step) const {
  const std::size_t k = span_.first + step;
  const std::vector<double>& times = bodies_->times();
  return {times[k], times[k + 1], bodies_->screw(f_, k), bodies_->screw(p_, k), bounds(step).acceleration};
}

RelativeMotion::StepTime RelativeMotion::stepAt(double time) const {
  std::size_t first = 0;
  for (std::size_t last = steps() - 1; first < last;) {
    const std::size_t middle = (first + last) / 2;
    if (time <= motion(middle).t_end) {
      last = middle;
    } else {
      first = middle + 1;
    }
  }
  const TwoBodyMotion step = motion(first);
  return {first, std::clamp((time - step.t_start) / (step.t_end - step.t_start), 0.0, 1.0)};
}

double RelativeMotion::givenError(const CycleMotion& motion, const PairResult& pair) const {
  if (motion.motion_error.empty()) return 0.0;
  const double error_a = motion.motion_error[pair.body_a], error_b = motion.motion_error[pair.body_b];
  const double scale = errorScaleOfF();
  return f_is_a_ ? scale * error_a + error_b : error_a + scale * error_b;
}

double RelativeMotion::errorScaleOfF() const {
  return is_f_in_ball_ ? 1.0 : std::max(1.0, reach() / kHalfSpaceRadius);
}

double RelativeMotion::reach() const {
  return (X_FP_start_ * ball_->center).norm() + ball_->radius + travel_;
}

}  // namespace sdf_ccd
