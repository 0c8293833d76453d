#include "pair_checker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/infinity.h"
#include "pair_result.h"
#include "pose_rounding.h"
#include "scene/pair_bound.h"
#include "untestable_pairs.h"

namespace sdf_ccd {
namespace {

constexpr double kStill = 1e-9;          // bodies rest if they move less relative to each other, by rounding [m]
constexpr double kRootTolerance = 1e-9;  // relative to the path; guaranteed by segmentIntervals()

/// Of a pair in contact.
std::string whyNoForce(const Body& a, const Body& b) {
  for (const Body* body : {&a, &b})
    if (body->forces != Forces::kKnown) return "no force: " + body->name + ": " + whyNoForces(body->forces);
  return "no force: neither body has a shell";
}

void requireFinite(const ErrorSources& error) {
  if (!std::isfinite(error.total())) throw std::runtime_error("its error bound is not finite");
}

}  // namespace

PairChecker::PairChecker(const Scene& scene, const PlannedPair& pair,
                         const std::vector<ContactCollector::BodyData>& body_data, const MonitorOptions& options)
    : scene_(scene),
      pair_(pair),
      body_data_(body_data),
      options_(options),
      resting_(scene.resting.get()),
      balls_contain_bodies_(scene.bodies[pair.body_a].half_spaces.empty() &&
                            scene.bodies[pair.body_b].half_spaces.empty()),
      roles_(scene, pair),
      contact_bound_(contactBound(scene, pair)) {
  if (haveSurfaces(scene, pair)) surfaces_.emplace(scene, pair, 0.5 * options.max_error);
  if (roles_.empty()) why_no_force_ = whyNoForce(scene.bodies[pair.body_a], scene.bodies[pair.body_b]);
  if (surfaces_ && ContactRefinement::isPossible(scene, pair))
    refinement_.emplace(scene, pair, surfaces_->resolution());
}

/// If false, the result holds the reason.
bool PairChecker::canBeChecked(const CycleMotion& motion, const SweptBodies& bodies, PairResult& result) {
  const auto because = [&](const std::string& reason) {
    setNotChecked(reason, result);
    return false;
  };
  static const std::string late = "its transforms have not arrived yet";  // made once: it is copied in each cycle
  if (result.span.empty()) return because(late);
  for (const int body : {pair_.body_a, pair_.body_b}) {
    const std::string& why = bodies.whyUnknown(motion, body);
    if (why.empty()) continue;
    forget();
    return because(why);
  }
  return surfaces_ ? true : because(kNotTestable);
}

void PairChecker::run(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                      PairMemory& memory, PairResult& result) {
  memory_ = &memory;
  is_to_complete_ = false;
  clear(result);
  if (!canBeChecked(motion, bodies, result)) return;
  const CancelScope scope(memory.deadline);
  try {
    check(motion, bodies, request, result);
    takeOff(request.margin, result);
  } catch (const std::exception& error) {
    forget();
    clear(result);
    setNotChecked(error.what(), result);
  }
}

/// Takes the margin off what check() has set with it.
void PairChecker::takeOff(double margin, PairResult& result) const {
  if (!(margin > 0.0)) return;
  result.error.chord = std::max(0.0, result.error.chord - margin);
  if (result.contact_error.total() > 0.0)
    result.contact_error.chord = std::max(0.0, result.contact_error.chord - margin);
  if (result.verdict == Verdict::kClear) result.clearance += margin;
}

void PairChecker::remember(double clearance, const Isometry3d& X_WA, const Isometry3d& X_WB) {
  if (!surfaces_) return;
  state_.clearance = clearance;
  state_.inside.reset();
  state_.X_FP = relativeMotion().f() == pair_.body_a ? relativePose(X_WA, X_WB) : relativePose(X_WB, X_WA);
}

/// Sets the motion, and subtracts from the clearance what it may have used up.
void PairChecker::setMotion(const SweptBodies& bodies, const WaypointSpan& span) {
  surfaces_->setMotion(bodies, span, memory_->bounds);
  const RelativeMotion& motion = surfaces_->motion();
  travel_ = motion.travel();
  motion_error_ = motion.poseError();
  const bool continues = state_.X_FP.matrix() == motion.start().matrix();
  if (!continues) {
    if (isKnown()) state_.clearance -= motion.jumpFrom(state_.X_FP);
    state_.outside = false;
    state_.inside.reset();
  }
  state_.clearance -= travel_;
  state_.X_FP = motion.end();
}

/// The motion error given with the motion, for both bodies together [m].
double PairChecker::givenError(const CycleMotion& motion) const {
  if (motion.motion_error.empty()) return 0.0;
  const RelativeMotion& relative = relativeMotion();
  const double error_a = motion.motion_error[pair_.body_a], error_b = motion.motion_error[pair_.body_b];
  const double scale = relative.errorScaleOfF();
  return relative.f() == pair_.body_a ? scale * error_a + error_b : error_a + scale * error_b;
}

void PairChecker::check(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                        PairResult& result) {
  setMotion(bodies, result.span);
  const double given_error = givenError(motion) + request.margin;
  motion_error_ += given_error;
  result.error = bound();
  result.error.chord = motion_error_;
  requireFinite(result.error);
  if (state_.clearance > motion_error_) {
    setClear(state_.clearance, result);
    result.skipped = true;
    return;
  }
  const bool rests = resting_ && travel_ <= kStill && !state_.inside;  // state_.inside is known from the motion before
  const double error_at_rest = motion_error_ + travel_;
  if (rests && isAnswered(bodies, error_at_rest, request, result)) return;
  test(motion, bodies, request, given_error, result);
  if (rests && mayTouch(result.verdict) && resting_->haveRested(restingBodies(), poseAtRest()))
    answerOnce(bodies, error_at_rest, request, result);
}

void PairChecker::test(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                       double given_error, PairResult& result) {
  SurfacePair::Answer answer;
  if (isClear(answer, result)) return;
  forgetClearance();
  if (answer.state == SeparationState::kOpen)
    answer.crossing = surfaces_->findContact(motion_error_, memory_->separation);
  if (answer.crossing) {
    is_to_complete_ = request.wantsContacts();
    if (!is_to_complete_) return setCrossing(*answer.crossing, result);
    return setIncomplete(*answer.crossing, motion, request, result);
  }
  result.verdict = Verdict::kUncertain;
  if (request.wantsContacts()) describe(motion, bodies, request, given_error, {}, result);
  if (result.verdict == Verdict::kUncertain) setOpen(answer.open_within, result);
}

void PairChecker::complete(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                           PairMemory& memory, PairResult& result) {
  if (!is_to_complete_) return;
  is_to_complete_ = false;
  memory_ = &memory;
  ContactPoint crossing = result.deepest;
  crossing.depth_error = 0.0;
  const ErrorSources error = result.error;
  clear(result);
  result.verdict = Verdict::kContact;
  result.error = error;
  try {
    const CancelScope scope(memory.deadline);
    surfaces_->setMotion(bodies, result.span, memory.bounds);
    describe(motion, bodies, request, givenError(motion), crossing, result);
  } catch (const Cancelled&) {
    setIncomplete(crossing, motion, request, result);
  } catch (const std::exception& problem) {
    forget();
    clear(result);
    setNotChecked(problem.what(), result);
  }
}

/// Computes the contacts of a pair whose surfaces cross, or may meet. If time ends after they are found, they are not
/// refined. @throws Cancelled if it ends before.
/// @param crossing  of the surfaces, or a point of one body inside the other, if one is known.
void PairChecker::describe(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                           double given_error, const std::optional<ContactPoint>& crossing, PairResult& result) {
  findContacts(motion, bodies, request, given_error, crossing, result);
  try {
    if (request.refine == Refinement::kDeepest && refinement_ && !result.intervals.empty())
      refinement_->run(bodies, *surfaces_, result.error.chord, memory_->refinement, result);
    surfaceContacts(result).completePeaks();
    if (request.wrenches && roles_.empty() && !result.intervals.empty()) {
      setWrenchesUnknown(result);
      result.reason = why_no_force_;
    }
  } catch (const Cancelled&) {
    result.incomplete = true;
    result.reason = "incomplete: the cycle's time was used up before the contact was measured on triangles";
  }
}

/// @param clearance  lower bound of the distance at the span's end, for the bodies at the given poses [m].
void PairChecker::setClear(double clearance, PairResult& result) {
  state_.clearance = clearance;
  result.verdict = Verdict::kClear;
  result.clearance = clearance - motion_error_;
}

SurfaceContacts PairChecker::surfaceContacts(PairResult& result) {
  return {scene_, pair_, *surfaces_, result.error.chord, memory_->separation, result};
}

/// Sets a contact of which only a crossing of the surfaces is known, or that one body is inside the other.
void PairChecker::setCrossing(const ContactPoint& crossing, PairResult& result) {
  result.verdict = Verdict::kContact;
  result.intervals.push_back({crossing.enter, crossing.exit});
  result.deepest = crossing;
}

/// The error of a pair that is UNCERTAIN. That of the triangles and the motion holds for a verdict; the true surfaces
/// may be farther apart, or overlap more, than the triangles by their deviation once again.
/// @param open_within  SurfacePair::Answer::open_within.
void PairChecker::setOpen(double open_within, PairResult& result) const {
  const double within = open_within < kInfinity ? open_within : greatestDepthOfContact();
  result.error.gap += within + surfaces_->deviation();
}

/// Whether the triangles prove that the bodies stay apart. @param answer  set if not.
bool PairChecker::isClear(SurfacePair::Answer& answer, PairResult& result) {
  answer = surfaces_->decide(motion_error_, memory_->separation);
  if (answer.state != SeparationState::kApart) {
    state_.inside.reset();
    return false;
  }
  if (answer.far) {
    state_.outside = true;
    state_.inside.reset();
  } else if (!state_.outside && !state_.inside) {
    findContainment();
  }
  if (state_.inside) answer.crossing = surfaces_->contactInside(*state_.inside);
  if (!state_.outside) return false;
  setClear(answer.clearance, result);
  return true;
}

/// Sets whether one body is inside the other, which takes many rays in a mesh whose inside is doubtful, and hardly
/// depends on small displacements. The surfaces must be apart.
void PairChecker::findContainment() {
  constexpr double kSmall = 0.1;
  const RelativeMotion& motion = surfaces_->motion();
  if (state_.undecided && motion.jumpFrom(state_.undecided->X_FP) < kSmall * surfaces_->size()) return;
  const int attempt = state_.undecided ? state_.undecided->attempts : 0;
  const SurfacePair::Containment found = surfaces_->containment(motion.end(), attempt);
  state_.outside = found.excluded;
  state_.inside = found.inside;
  state_.undecided.reset();
  if (!state_.outside && !state_.inside) state_.undecided = {motion.end(), attempt + 1};
}

std::optional<double> PairChecker::measure(const CycleMotion& motion, const SweptBodies& bodies,
                                           const WaypointSpan& span, PairMemory& memory) {
  if (!surfaces_ || !bodies.problem(pair_.body_a).empty() || !bodies.problem(pair_.body_b).empty()) return {};
  surfaces_->setMotion(bodies, span, memory.bounds);
  const double error = surfaces_->motion().poseError() + givenError(motion);
  const SurfacePair::Answer answer = surfaces_->decide(error, memory.separation);
  if (answer.state != SeparationState::kApart) return {};
  return answer.clearance;
}

/// Finds contacts by the points of the shells in the fields: with the errors of both, and those of the chords.
void PairChecker::findContacts(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                               double given_error, const std::optional<ContactPoint>& crossing, PairResult& result) {
  ErrorSources error = contact_bound_;
  error.chord = result.error.chord;
  if (!roles_.empty()) {
    roles_.setMotion(bodies, result.span, memory_->roles);
    const double pose_error = roles_.poseError() + given_error;
    error.root = kRootTolerance * roles_.travel();
    error.chord = std::max(pose_error, roles_.cut(options_.chords) + pose_error);
    requireFinite(error);
  }
  result.contact_error = error;
  ContactCollector& collector = memory_->collector;
  collector.begin(motion, result, crossing.has_value());
  roles_.addContacts(body_data_, options_.contact, request.wrenches, collector);
  collector.finish(request, result);
  if (crossing) surfaceContacts(result).add(*crossing);
  if (result.intervals.empty()) result.contact_error = {};
}

}  // namespace sdf_ccd
