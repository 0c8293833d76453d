// What is said of a pair if the cycle's time ends before it is tested, or before its contact is computed.
#include <algorithm>
#include <limits>

#include "pair_checker.h"
#include "pair_result.h"
#include "pose_rounding.h"
#include "scene/pair_bound.h"

namespace sdf_ccd {

void PairChecker::postpone(const CycleMotion& motion, const SweptBodies& bodies, double clearance, double margin,
                           PairMemory& memory, PairResult& result) {
  memory_ = &memory;
  clear(result);
  if (!canBeChecked(motion, bodies, result)) return;
  double apart = PairState::kUnknown;
  if (balls_contain_bodies_) {
    apart = ballClearance(bodies, result.span);
    motion_error_ = 0.0;
    for (const int body : {pair_.body_a, pair_.body_b}) {
      const BoundingBall& ball = scene_.bodies[body].ball;
      motion_error_ += bodies.poseError(body, ball.center.norm() + ball.radius);  // of a point that lies in both
    }
  } else {
    surfaces_->setMotion(bodies, result.span, memory_->bounds);
    const RelativeMotion& relative = surfaces_->motion();
    motion_error_ = relative.poseError();
    apart = surfaces_->ballClearance(relative.start()) - relative.travel();
  }
  motion_error_ += givenError(motion);
  result.error = bound();
  result.error.chord = motion_error_;
  if (balls_contain_bodies_ && apart > motion_error_ + margin) {
    remember(apart, motion.pose(pair_.body_a, result.span.last), motion.pose(pair_.body_b, result.span.last));
    setClear(apart, result);
    result.skipped = state_.outside = true;
    return;
  }
  result.verdict = Verdict::kUncertain;
  result.postponed = true;
  result.reason = "postponed: the cycle's time was used up";
  result.error.chord += std::max(0.0, -std::max(clearance, apart));
  state_.clearance = clearance;
  state_.outside = false;
  state_.inside.reset();
}

/// Lower bound of the distance of the bodies' balls over the whole span [m]; if negative, its amount bounds their
/// overlap. With a constant twist the speed of a ball's centre is constant, so the centre is always within half of its
/// path from its position at half time.
double PairChecker::ballClearance(const SweptBodies& bodies, const WaypointSpan& span) const {
  double clearance = std::numeric_limits<double>::infinity();
  for (std::size_t k = span.first; k < span.last; ++k) {
    const WorldTwist &a = bodies.twist(pair_.body_a, k), &b = bodies.twist(pair_.body_b, k);
    const double away = 0.5 * (a.velocity.norm() + b.velocity.norm());
    clearance = std::min(clearance, (a.center - b.center).norm() - away - a.radius - b.radius);
  }
  return clearance;
}

/// Sets a contact of which only a proof is known. It may last for the whole span, and be as deep as the bodies allow;
/// its force is not known.
void PairChecker::setIncomplete(const ContactPoint& proof, const CycleMotion& motion, const CycleRequest& request,
                                PairResult& result) {
  const ErrorSources error = result.error;
  clear(result);
  result.error = error;
  result.verdict = Verdict::kContact;
  result.incomplete = true;
  result.reason = "incomplete: the cycle's time was used up before the contact's times, depth and force were known";
  result.intervals.push_back({motion.times[result.span.first], motion.times[result.span.last]});
  result.deepest = proof;
  result.deepest.depth_error = std::max(proof.depth_error, greatestDepthOfContact() - proof.depth);
  if (request.wrenches) setWrenchesUnknown(result);
}

/// Upper bound of the depth of any point of one body in the other, at any time of the motion [m].
double PairChecker::greatestDepthOfContact() const {
  const double errors = contact_bound_.field + motion_error_;
  if (surfaces_->isWithHalfSpace())
    return errors + surfaces_->deviation() + surfaces_->motion().travel() -
           surfaces_->ballClearance(surfaces_->motion().start());
  return errors + std::max(greatestDepth(scene_.bodies[pair_.body_a]), greatestDepth(scene_.bodies[pair_.body_b]));
}

}  // namespace sdf_ccd
