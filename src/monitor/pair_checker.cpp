#include "pair_checker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "pair_bound.h"
#include "pair_result.h"
#include "pose_rounding.h"
#include "surface_crossing.h"
#include "untestable_pairs.h"

namespace sdf_ccd {
namespace {

constexpr double kStill = 1e-9;          // bodies rest if they move less relative to each other, by rounding [m]
constexpr double kRootTolerance = 1e-9;  // relative to the path; guaranteed by segmentIntervals()

void requireFinite(const ErrorBound& error) {
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
      balls_contain_bodies_(ballContainsBody(scene.bodies[pair.body_a]) && ballContainsBody(scene.bodies[pair.body_b])),
      open_(isInsideUncertain(scene.bodies[pair.body_a]) || isInsideUncertain(scene.bodies[pair.body_b])),
      roles_(scene, pair) {
  if (trianglesDecide(scene, pair)) surfaces_.emplace(scene, pair, 0.5 * options.max_error);
  if (surfaces_ && ContactRefinement::isPossible(scene, pair))
    refinement_.emplace(scene, pair, surfaces_->resolution());
  bound_ = pairBound(scene, pair);
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
  if (!pair_.isTestable()) return because(kNotTestable);
  if (!roles_.areBuilt()) return because("its fields and shells were not built");
  return true;
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
  if (roles_.empty()) return;
  clearance_ = clearance;
  inside_.reset();
  X_FP_last_ = relativeMotion().f() == pair_.body_a ? relativePose(X_WA, X_WB) : relativePose(X_WB, X_WA);
}

void PairChecker::take(const PairChecker& other) {
  clearance_ = other.clearance_;
  outside_ = other.outside_;
  inside_ = other.inside_;
  X_FP_last_ = other.X_FP_last_;
  untold_ = other.untold_;
  X_AB_as_it_came_ = other.X_AB_as_it_came_;
  if (surfaces_) surfaces_->take(*other.surfaces_);
}

/// Sets the motion, and subtracts from the clearance what it may have used up.
void PairChecker::setMotion(const SweptBodies& bodies, const WaypointSpan& span) {
  if (surfaces_) {
    surfaces_->setMotion(bodies, span, memory_->bounds);
    travel_ = surfaces_->motion().travel();
    motion_error_ = surfaces_->motion().poseError();
  } else {
    setRoles(bodies, span);
  }
  const RelativeMotion& motion = relativeMotion();
  const bool continues = X_FP_last_.matrix() == motion.start().matrix();
  if (!continues) {
    if (isKnown()) clearance_ -= motion.jumpFrom(X_FP_last_);
    outside_ = false;
    inside_.reset();
  }
  clearance_ -= travel_;
  X_FP_last_ = motion.end();
}

void PairChecker::setRoles(const SweptBodies& bodies, const WaypointSpan& span) {
  roles_.setMotion(bodies, span, memory_->roles);
  travel_ = roles_.travel();
  motion_error_ = roles_.poseError();
}

/// The motion error given with the motion, for both bodies together [m].
double PairChecker::givenError(const CycleMotion& motion, const RelativeMotion& relative) const {
  if (motion.motion_error.empty()) return 0.0;
  const double error_a = motion.motion_error[pair_.body_a], error_b = motion.motion_error[pair_.body_b];
  const double scale = relative.errorScaleOfF();
  return relative.f() == pair_.body_a ? scale * error_a + error_b : error_a + scale * error_b;
}

/// @param bound  without the motion's error. @throws std::runtime_error if the sum is not finite.
void PairChecker::setError(const ErrorBound& bound, double root, PairResult& result) const {
  result.error = bound;
  result.error.chord = motion_error_;
  result.error.root = root;
  requireFinite(result.error);
}

void PairChecker::check(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                        PairResult& result) {
  setMotion(bodies, result.span);
  const double given_error = givenError(motion, relativeMotion()) + request.margin;
  motion_error_ += given_error;
  setError(bound(), surfaces_ ? 0.0 : kRootTolerance * travel_, result);
  const double margin = this->margin() + result.error.chord + result.error.root;
  if (clearance_ > margin) {
    setClear(clearance_, result);
    result.skipped = true;
    return;
  }
  const bool rests = resting_ && travel_ <= kStill && !inside_;  // inside_ is known from the motion before
  const double error_at_rest = motion_error_ + travel_;          // test() may change them to those of fields
  if (rests && isAnswered(bodies, error_at_rest, request, result)) return;
  test(motion, bodies, request, given_error, margin, result);
  if (rests && mayTouch(result.verdict) && resting_->haveRested(restingBodies(), poseAtRest()))
    answerOnce(bodies, error_at_rest, request, result);
}

void PairChecker::test(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                       double given_error, double margin, PairResult& result) {
  SurfacePair::Answer by_surfaces;
  const ErrorBound surface_error = result.error;
  if (surfaces_) {
    if (clearBySurfaces(by_surfaces, result)) return;
    if (by_surfaces.crossing) {
      forgetClearance();
      is_to_complete_ = request.wantsContacts();
      if (!is_to_complete_) return setCrossing(*by_surfaces.crossing, result);
      return setIncomplete(*by_surfaces.crossing, motion, request, result);
    }
    // Fields tell no more of a half-space than its surface does.
    if (surfaces_->isWithHalfSpace() && !request.wantsContacts()) {
      forgetClearance();
      result.verdict = Verdict::kUncertain;
      return setSurfaceError(by_surfaces.open_within, surface_error, result);
    }
    setRoles(bodies, result.span);
    motion_error_ += given_error;
    setError(bound_, kRootTolerance * travel_, result);
  } else if (const auto clearance = roles_.clearanceByBalls(margin)) {
    setClear(*clearance, result);
    return doubt(result);
  }

  cutMotion(result);
  const double near = result.error.total();
  if (roles_.mayComeNearer(near)) {
    forgetClearance();
    describe(motion, bodies, request, by_surfaces, result);
    doubt(result);
    if (by_surfaces.state == SeparationState::kApart) keepInside(result);
    return setSurfaceError(by_surfaces.open_within, surface_error, result);
  }
  // With both shells the surfaces' distance is known up to the gap; with one, up to its covering radius.
  setClear(roles_.pointClearanceAtEnd(0.5 * near) - bound_.gap, result);
  doubt(result);
  outside_ = result.verdict == Verdict::kClear;
  setSurfaceError(kInfinity, surface_error, result);
}

void PairChecker::cutMotion(PairResult& result) {
  result.error.chord = std::max(result.error.chord, roles_.cut(options_.chords) + motion_error_);
  requireFinite(result.error);
}

void PairChecker::complete(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                           PairMemory& memory, PairResult& result) {
  if (!is_to_complete_) return;
  is_to_complete_ = false;
  memory_ = &memory;
  SurfacePair::Answer known;
  known.state = inside_ ? SeparationState::kApart : SeparationState::kCrossing;
  known.crossing = result.deepest;
  known.crossing->depth_error = 0.0;
  const ErrorBound surface_error = result.error;
  clear(result);
  try {
    const CancelScope scope(memory.deadline);
    surfaces_->setMotion(bodies, result.span, memory.bounds);
    setRoles(bodies, result.span);
    motion_error_ += givenError(motion, surfaces_->motion());
    setError(bound_, kRootTolerance * travel_, result);
    cutMotion(result);
    describe(motion, bodies, request, known, result);
    if (inside_) keepInside(result);
    setSurfaceError(kInfinity, surface_error, result);
  } catch (const Cancelled&) {
    result.error = surface_error;
    setIncomplete(*known.crossing, motion, request, result);
  } catch (const std::exception& error) {
    forget();
    clear(result);
    setNotChecked(error.what(), result);
  }
}

/// Computes the contacts of a pair whose surfaces may meet. If time ends after they are proved, they are incomplete.
/// @throws Cancelled if it ends before.
void PairChecker::describe(const CycleMotion& motion, const SweptBodies& bodies, const CycleRequest& request,
                           const SurfacePair::Answer& by_surfaces, PairResult& result) {
  std::optional<ContactPoint> crossing = by_surfaces.crossing;
  if (!crossing && open_ && by_surfaces.state != SeparationState::kApart)
    crossing = crossingAtARecordedTime(scene_, motion, result, motion_error_);
  bool have_wrench = false;
  try {
    findContacts(motion, request, crossing, result);
    have_wrench = true;
    if (request.refine == Refinement::kDeepest && refinement_ && !result.intervals.empty())
      refinement_->run(bodies, *surfaces_, motion_error_, memory_->refinement, result);
    if (surfaces_) surfaceContacts(result).completePeaks();
  } catch (const Cancelled&) {
    if (have_wrench) {
      result.incomplete = true;
      result.reason = "incomplete: the cycle's time was used up before the contact was measured on triangles";
    } else if (crossing) {
      setIncomplete(*crossing, motion, request, result);
    } else if (isDeep(result)) {
      setIncomplete(memory_->collector.certain().contact, motion, request, result);
    } else {
      throw;
    }
  }
}

/// Sets UNCERTAIN if the verdict rests on fields of a body whose inside is doubtful.
void PairChecker::doubt(PairResult& result) {
  if (result.verdict == Verdict::kNotChecked || isCertain(result)) return;
  result.verdict = Verdict::kUncertain;
  result.clearance = -1.0;
  forgetClearance();
}

/// Whether a verdict from fields holds although the outside or inside of a body may be doubtful.
bool PairChecker::isCertain(const PairResult& result) const {
  const bool is_clear = result.verdict == Verdict::kClear;
  if (surfaces_) return !(is_clear ? surfaces_->isOutsideDoubtful() : surfaces_->isInsideDoubtful());
  if (!is_clear) return true;  // fields report by themselves what is certain of a contact
  for (const int body : {pair_.body_a, pair_.body_b}) {
    const Body& other = scene_.bodies[body == pair_.body_a ? pair_.body_b : pair_.body_a];
    const bool is_bounded = other.shell->size() > 0 || other.witnesses->size() > 0;  // half-spaces lie inside no body
    if (scene_.bodies[body].doubtful && is_bounded && !roles_.isOutsideAtEnd(body)) return false;
  }
  return true;
}

/// @param clearance  lower bound of the distance at the span's end, for the bodies at the given poses [m].
void PairChecker::setClear(double clearance, PairResult& result) {
  clearance_ = clearance;
  result.verdict = Verdict::kClear;
  result.clearance = clearance - motion_error_;
}

SurfaceContacts PairChecker::surfaceContacts(PairResult& result) {
  return {scene_, pair_, surfaces_ ? &*surfaces_ : nullptr, motion_error_, memory_->separation, result};
}

/// Sets a contact of which only a crossing of the surfaces is known, or that one body is inside the other.
void PairChecker::setCrossing(const ContactPoint& crossing, PairResult& result) {
  result.verdict = Verdict::kContact;
  result.intervals.push_back({crossing.enter, crossing.exit});
  result.deepest = crossing;
}

/// The verdict's error if both bodies have triangles: that of the triangles and of the motion, also if fields decided.
/// For fields call a pair CLEAR only if no point of a shell, whose surface is within the gap of its points, comes
/// closer in the field than field + gap + chord + root: the surfaces then stay apart even if all of these errors reach
/// their bounds. They call it CONTACT if a point is certainly deeper in the field than chord + root. So these errors
/// are already accounted for. What remains is the motion's error, which no check removes, and the deviation of the
/// triangles that stand for a curved surface. An UNCERTAIN pair is so up to the triangles' resolution if these found
/// the surfaces near, otherwise up to the errors of the fields.
/// @param open_within  SurfacePair::Answer::open_within. @param error  of the triangles and the motion.
void PairChecker::setSurfaceError(double open_within, const ErrorBound& error, PairResult& result) const {
  const bool is_open = result.verdict == Verdict::kUncertain;
  if (!surfaces_ || (is_open && open_within == kInfinity)) return;
  result.error = error;
  // That is of the triangles; the true surfaces may be farther apart, or overlap more, by their deviation once again.
  if (is_open) result.error.gap += open_within + surfaces_->deviation();
}

/// Whether the triangles prove that the bodies stay apart. @param answer  set if not.
bool PairChecker::clearBySurfaces(SurfacePair::Answer& answer, PairResult& result) {
  answer = surfaces_->decide(motion_error_, memory_->separation);
  if (answer.state != SeparationState::kApart) {
    inside_.reset();
    return false;
  }
  if (answer.far) {
    outside_ = true;
    inside_.reset();
  } else if (!outside_ && !inside_) {
    findContainment();
  }
  if (inside_) answer.crossing = surfaces_->contactInside(*inside_);
  if (!outside_) return false;
  setClear(answer.clearance, result);
  return true;
}

/// Sets whether one body is inside the other, which takes many rays in a mesh whose inside is doubtful, and hardly
/// depends on small displacements. The surfaces must be apart.
void PairChecker::findContainment() {
  constexpr double kSmall = 0.1;
  const RelativeMotion& motion = surfaces_->motion();
  if (untold_ && motion.jumpFrom(untold_->X_FP) < kSmall * surfaces_->size()) return;
  const int attempt = untold_ ? untold_->attempts : 0;
  const SurfacePair::Containment found = surfaces_->containment(motion.end(), attempt);
  outside_ = found.excluded;
  inside_ = found.inside;
  untold_.reset();
  if (!outside_ && !inside_) untold_ = {motion.end(), attempt + 1};
}

std::optional<double> PairChecker::measure(const CycleMotion& motion, const SweptBodies& bodies,
                                           const WaypointSpan& span, PairMemory& memory) {
  if (!surfaces_ || !bodies.problem(pair_.body_a).empty() || !bodies.problem(pair_.body_b).empty()) return {};
  surfaces_->setMotion(bodies, span, memory.bounds);
  const double error = surfaces_->motion().poseError() + givenError(motion, surfaces_->motion());
  const SurfacePair::Answer answer = surfaces_->decide(error, memory.separation);
  if (answer.state != SeparationState::kApart) return {};
  return answer.clearance;
}

/// @param crossing  of the surfaces, if one is known.
void PairChecker::findContacts(const CycleMotion& motion, const CycleRequest& request,
                               const std::optional<ContactPoint>& crossing, PairResult& result) {
  ContactCollector& collector = memory_->collector;
  collector.begin(motion, result, crossing.has_value());
  roles_.addContacts(body_data_, options_.contact, request.wrenches, collector);
  collector.finish(request, result);
  if (crossing || !result.intervals.empty()) result.contact_error = result.error;
  if (crossing) surfaceContacts(result).add(*crossing);
  // CONTACT is certain, whatever the gap between points and the field's error are: a point of the surface is deeper
  // than the motion's error.
  result.verdict = isDeep(result) || collector.crosses() ? Verdict::kContact : Verdict::kUncertain;
}

/// Whether findContacts() has found a point that is deeper than the motion's error.
bool PairChecker::isDeep(const PairResult& result) const {
  return memory_->collector.certain().depth > result.error.chord + result.error.root;
}

/// Keeps a point that proves CONTACT while the surfaces are apart: it stays inside until they meet.
void PairChecker::keepInside(const PairResult& result) {
  if (result.verdict != Verdict::kContact || !isDeep(result)) return;
  const ContactCollector::CertainPoint& certain = memory_->collector.certain();
  const bool is_of_p = surfaces_->motion().p() == (certain.is_of_a ? pair_.body_a : pair_.body_b);
  inside_ = SurfacePair::InsidePoint{is_of_p, certain.p};
}

}  // namespace sdf_ccd
