#include "check_pair.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "common/infinity.h"
#include "pair_at_rest.h"
#include "pair_result.h"
#include "untestable_pairs.h"

namespace sdf_ccd {
namespace {

constexpr double kStill = 1e-9;  // bodies rest if they move less relative to each other, by rounding [m]

/// If false, the result holds the reason.
bool canBeChecked(const PairCycle& cycle, MonitoredPair& pair, PairResult& result) {
  const auto because = [&](const std::string& reason) {
    setNotChecked(reason, result);
    return false;
  };
  static const std::string late = "its transforms have not arrived yet";  // made once: it is copied in each cycle
  if (result.span.empty()) return because(late);
  for (const int body : {result.body_a, result.body_b}) {
    const std::string& why = cycle.bodies.whyUnknown(cycle.motion, body);
    if (why.empty()) continue;
    pair.forget();
    return because(why);
  }
  return pair.verdict.isPossible() ? true : because(kNotTestable);
}

/// Calls check(); if it cannot be computed, the pair is NOT_CHECKED.
template <class Check>
void checkOrExplain(MonitoredPair& pair, PairResult& result, const Check& check) {
  try {
    check();
  } catch (const std::exception& problem) {
    pair.forget();
    clear(result);
    setNotChecked(problem.what(), result);
  }
}

/// Subtracts the margin from the errors that check() has set with it: it is a wish, not an error.
void subtractMargin(double margin, PairResult& result) {
  if (!(margin > 0.0)) return;
  const auto subtract = [&](double& error) { error = std::max(0.0, error - margin); };
  subtract(result.error.chord);
  if (result.contact_error.total() > 0.0) subtract(result.contact_error.chord);
  if (result.measured) {
    subtract(result.deepest.depth_error);
    for (ContactPoint& peak : result.peaks) subtract(peak.depth_error);
  }
  if (result.verdict == Verdict::kClear) result.clearance += margin;
}

double greatestDepth(MonitoredPair& pair, const PairResult& result) {
  return pair.measure.greatestDepth(pair.verdict.surfaces(), pair.force.bound().field + result.error.chord);
}

/// Sets a contact of which only a crossing of the surfaces is known, or that one body is inside the other.
void setCrossing(const ContactPoint& crossing, PairResult& result) {
  result.verdict = Verdict::kContact;
  result.intervals.push_back({crossing.enter, crossing.exit});
  result.deepest = crossing;
}

/// Sets a contact of which only a proof is known. It may last for the whole span, and be as deep as the bodies allow;
/// its force is not known.
void setIncomplete(const PairCycle& cycle, const ContactPoint& proof, MonitoredPair& pair, PairResult& result) {
  const ErrorSources error = result.error;
  clear(result);
  result.error = error;
  result.verdict = Verdict::kContact;
  result.incomplete = true;
  result.reason = "incomplete: the cycle's time was used up before the contact's times, depth and force were known";
  result.intervals.push_back({cycle.motion.times[result.span.first], cycle.motion.times[result.span.last]});
  result.deepest = proof;
  result.deepest.depth_error = std::max(proof.depth_error, greatestDepth(pair, result) - proof.depth);
  if (cycle.request.wrenches) setWrenchesUnknown(result);
}

/// Computes the contacts of a pair whose surfaces cross, or may meet. @throws Cancelled if time ends before they are
/// known; some intervals may then still lack a deepest point.
/// @param crossing     of the surfaces, or a point of one body inside the other, if one is known.
/// @param given_error  RelativeMotion::givenError(), and the margin where result.error contains it [m].
void describe(const PairCycle& cycle, const std::optional<ContactPoint>& crossing, double given_error,
              MonitoredPair& pair, PairResult& result) {
  SurfacePair& surfaces = pair.verdict.surfaces();
  SeparationMemory& memory = cycle.memory.separation;
  const bool is_exact = pair.measure.isExact();
  if (!is_exact || cycle.request.wantsPoints())
    pair.force.findContacts(cycle, given_error, crossing.has_value(), result);
  if (is_exact) {
    pair.measure.measure(cycle, crossing, surfaces, result);
  } else {
    if (crossing) pair.measure.addCrossing(*crossing, surfaces, memory, result);
    if (result.intervals.empty()) result.contact_error = {};
    try {
      pair.measure.addPeaks(surfaces, memory, result);
    } catch (const Cancelled&) {
      result.incomplete = true;
      result.reason = "incomplete: the cycle's time was used up before each interval had its deepest point";
      return;
    }
  }
  if (cycle.request.wrenches && !result.intervals.empty()) pair.force.explainNone(result);
}

/// Decides by the surfaces, and describes what is not clear.
void test(const PairCycle& cycle, double given_error, MonitoredPair& pair, PairResult& result) {
  const PairVerdict::Answer answer = pair.verdict.decide(result.error.chord, cycle.memory.separation);
  if (answer.verdict == Verdict::kClear) return setClear(pair.verdict.clearance(), result);
  if (answer.verdict == Verdict::kContact) {
    pair.is_to_complete = cycle.request.wantsContacts();
    if (!pair.is_to_complete) return setCrossing(*answer.crossing, result);
    return setIncomplete(cycle, *answer.crossing, pair, result);
  }
  result.verdict = Verdict::kUncertain;
  if (cycle.request.wantsContacts()) describe(cycle, {}, given_error, pair, result);
  if (result.verdict != Verdict::kUncertain) return;
  // The error of the triangles and the motion holds for a verdict; the true surfaces may be farther apart, or overlap
  // more, than the triangles by their deviation once again.
  const double within = answer.open_within < kInfinity ? answer.open_within : greatestDepth(pair, result);
  result.error.gap += within + pair.verdict.deviation();
}

void check(const PairCycle& cycle, MonitoredPair& pair, PairResult& result) {
  pair.verdict.setMotion(cycle.motionOf(result), cycle.memory.bounds);
  const RelativeMotion& motion = pair.verdict.surfaces().motion();
  const double given_error = motion.givenError(cycle.motion, result) + cycle.request.margin;
  result.error = {0.0, motion.poseError() + given_error, 0.0, pair.verdict.deviation()};
  requireFinite(result.error);
  if (pair.verdict.clearance() > result.error.chord) {
    setClear(pair.verdict.clearance(), result);
    result.skipped = true;
    return;
  }
  const bool rests = cycle.resting && motion.travel() <= kStill && !pair.verdict.isInside();
  const double error_at_rest = result.error.chord + motion.travel();
  if (rests && isAnsweredAtRest(cycle, error_at_rest, pair, result)) return;
  test(cycle, given_error, pair, result);
  if (rests && mayTouch(result.verdict)) answerAtRest(cycle, error_at_rest, pair, result);
}

/// Lower bound of the distance of the bodies' balls over the whole span [m]; if negative, its amount bounds their
/// overlap. With a constant twist the speed of a ball's centre is constant, so the centre is always within half of its
/// path from its position at half time.
double ballClearance(const PairMotion& pair) {
  double clearance = kInfinity;
  for (std::size_t k = pair.span.first; k < pair.span.last; ++k) {
    const WorldTwist &a = pair.bodies.twist(pair.body_a, k), &b = pair.bodies.twist(pair.body_b, k);
    const double away = 0.5 * (a.velocity.norm() + b.velocity.norm());
    clearance = std::min(clearance, (a.center - b.center).norm() - away - a.radius - b.radius);
  }
  return clearance;
}

}  // namespace

MonitoredPair::MonitoredPair(SharedBody of_a, SharedBody of_b, const PlannedPair& pair, double max_error)
    : a(std::move(of_a)),
      b(std::move(of_b)),
      verdict(*a->body, *b->body, 0.5 * max_error),
      force(*a, *b, pair),
      measure(*a->body, *b->body, pair, 0.5 * max_error) {}

void checkPair(const PairCycle& cycle, MonitoredPair& pair, PairResult& result) {
  clear(result);
  if (!canBeChecked(cycle, pair, result)) return;
  pair.is_to_complete = false;
  const CancelScope scope(cycle.memory.deadline);
  checkOrExplain(pair, result, [&] {
    check(cycle, pair, result);
    subtractMargin(cycle.request.margin, result);
  });
}

void completePair(const PairCycle& cycle, MonitoredPair& pair, PairResult& result) {
  if (!result.incomplete || !pair.is_to_complete) return;
  pair.is_to_complete = false;
  ContactPoint crossing = result.deepest;
  crossing.depth_error = 0.0;
  const ErrorSources error = result.error;
  clear(result);
  result.verdict = Verdict::kContact;
  result.error = error;
  checkOrExplain(pair, result, [&] {
    SurfacePair& surfaces = pair.verdict.surfaces();
    try {
      const CancelScope scope(cycle.memory.deadline);
      surfaces.setMotion(cycle.motionOf(result), cycle.memory.bounds);
      describe(cycle, crossing, surfaces.motion().givenError(cycle.motion, result), pair, result);
    } catch (const Cancelled&) {
      setIncomplete(cycle, crossing, pair, result);
    }
  });
}

void postponePair(const PairCycle& cycle, double clearance, MonitoredPair& pair, PairResult& result) {
  clear(result);
  if (!canBeChecked(cycle, pair, result)) return;
  const PairMotion motion = cycle.motionOf(result);
  SurfacePair& surfaces = pair.verdict.surfaces();
  const bool balls_contain_bodies = pair.a->body->half_spaces.empty() && pair.b->body->half_spaces.empty();
  result.error.gap = pair.verdict.deviation();
  double apart = 0.0;
  if (balls_contain_bodies) {
    apart = ballClearance(motion);
    const auto errorOf = [&](int body, const BoundingBall& ball) {
      return cycle.bodies.poseError(body, ball.center.norm() + ball.radius);  // of a point that lies in both
    };
    result.error.chord = errorOf(result.body_a, pair.a->body->ball) + errorOf(result.body_b, pair.b->body->ball);
  } else {
    surfaces.setMotion(motion, cycle.memory.bounds);
    result.error.chord = surfaces.motion().poseError();
    apart = surfaces.ballClearance(surfaces.motion().start()) - surfaces.motion().travel();
  }
  result.error.chord += surfaces.motion().givenError(cycle.motion, result);
  if (balls_contain_bodies && apart > result.error.chord + cycle.request.margin) {
    const std::size_t last = result.span.last;
    pair.verdict.setFar(apart, cycle.motion.pose(result.body_a, last), cycle.motion.pose(result.body_b, last));
    setClear(apart, result);
    result.skipped = true;
    return;
  }
  result.verdict = Verdict::kUncertain;
  result.postponed = true;
  result.reason = "postponed: the cycle's time was used up";
  result.error.chord += std::max(0.0, -std::max(clearance, apart));
  pair.verdict.postpone(clearance);
}

std::optional<double> measureClearance(const PairCycle& cycle, MonitoredPair& pair, const PairResult& result) {
  if (!pair.verdict.isPossible()) return {};
  for (const int body : {result.body_a, result.body_b})
    if (!cycle.bodies.problem(body).empty()) return {};
  SurfacePair& surfaces = pair.verdict.surfaces();
  surfaces.setMotion(cycle.motionOf(result), cycle.memory.bounds);
  const double error = surfaces.motion().poseError() + surfaces.motion().givenError(cycle.motion, result);
  const SurfacePair::Answer answer = surfaces.decide(error, cycle.memory.separation);
  if (answer.state != SeparationState::kApart) return {};
  return answer.clearance;
}

}  // namespace sdf_ccd
