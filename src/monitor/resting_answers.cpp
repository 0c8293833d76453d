#include "resting_answers.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "motion/screw_motion.h"
#include "motion/two_body_motion.h"
#include "pair_result.h"
#include "swept_bodies.h"

namespace sdf_ccd {
namespace {

auto fieldsOf(const ContactOptions& options) {
  return std::tie(options.stiffness_per, options.stiffness, options.damping, options.normal, options.quadrature,
                  options.midpoint_intervals);
}

bool areEqual(const MonitorOptions& a, const MonitorOptions& b) {
  return fieldsOf(a.contact) == fieldsOf(b.contact) && a.chords.tolerance == b.chords.tolerance &&
         a.chords.max_chords == b.chords.max_chords && a.max_error == b.max_error;
}

/// Whether what was computed for one request contains what another one wants.
bool contains(const CycleRequest& known, const CycleRequest& wanted) {
  if (!wanted.wantsContacts()) return true;
  return known.wantsContacts() && known.wrenches >= wanted.wrenches && known.max_points >= wanted.max_points;
}

/// A larger error leaves open what a smaller one does; what a larger one proves, a smaller one does, too.
bool holdsFor(const RestingAnswer& answer, double error) {
  if (answer.result.verdict == Verdict::kContact) return error <= answer.error;
  return answer.error <= RestingAnswers::errorFor(error) + RestingAnswers::kMoved;
}

/// Whether neither body moves by more than kMoved relative to the other one.
bool areSame(const Isometry3d& X_AB, const Isometry3d& other, const RestingAnswers::Bodies& bodies) {
  return std::max(maxDisplacement(X_AB, other, bodies.second->ball),
                  maxDisplacement(X_AB.inverse(), other.inverse(), bodies.first->ball)) <= RestingAnswers::kMoved;
}

/// Poses of a body over a span of a cycle.
class SpanPoses {
 public:
  SpanPoses(const SweptBodies& bodies, int body, const WaypointSpan& span)
      : bodies_(bodies), body_(body), span_(span) {}

  Isometry3d at(double time) const {
    std::size_t k = span_.first;
    while (k + 1 < span_.last && bodies_.times()[k + 1] < time) ++k;
    const double start = bodies_.times()[k], end = bodies_.times()[k + 1];
    return bodies_.screw(body_, k).pose(std::clamp((time - start) / (end - start), 0.0, 1.0));
  }

 private:
  const SweptBodies& bodies_;
  int body_;
  WaypointSpan span_;
};

}  // namespace

std::shared_ptr<const RestingAnswer> RestingAnswers::find(const Bodies& bodies, const Isometry3d& X_AB, double error,
                                                          const CycleRequest& request,
                                                          const MonitorOptions& options) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = entries_.find({bodies.first.get(), bodies.second.get()});
  if (found == entries_.end() || found->second.a.lock() != bodies.first || found->second.b.lock() != bodies.second)
    return nullptr;
  for (const auto& answer : found->second.answers) {
    if (!contains(answer->request, request) || !areEqual(answer->options, options)) continue;
    if (areSame(answer->X_AB, X_AB, bodies) && holdsFor(*answer, error + kMoved)) return answer;
  }
  return nullptr;
}

bool RestingAnswers::haveRested(const Bodies& bodies, const Isometry3d& X_AB) {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::optional<Isometry3d>& rested = entryOf(bodies).X_AB_rested;
  const bool have = rested && areSame(*rested, X_AB, bodies);
  rested = X_AB;
  return have;
}

void RestingAnswers::keep(const Bodies& bodies, std::shared_ptr<const RestingAnswer> answer) {
  constexpr std::size_t kMost = 16;  // per pair: for different errors and requests
  const std::lock_guard<std::mutex> lock(mutex_);
  Entry& entry = entryOf(bodies);
  if (entry.answers.size() >= kMost) entry.answers.erase(entry.answers.begin());
  entry.answers.push_back(std::move(answer));
}

RestingAnswers::Entry& RestingAnswers::entryOf(const Bodies& bodies) {
  if (entries_.size() >= size_at_drop_) dropOld();
  Entry& entry = entries_[{bodies.first.get(), bodies.second.get()}];
  if (entry.a.lock() != bodies.first || entry.b.lock() != bodies.second) entry = {bodies.first, bodies.second, {}, {}};
  return entry;
}

/// Removes the answers of bodies that no scene has any more.
void RestingAnswers::dropOld() {
  for (auto entry = entries_.begin(); entry != entries_.end();)
    entry = entry->second.a.expired() || entry->second.b.expired() ? entries_.erase(entry) : std::next(entry);
  size_at_drop_ = std::max<std::size_t>(64, 2 * entries_.size());
}

void setResting(const RestingAnswer& answer, const SweptBodies& bodies, double error, int max_points,
                PairResult& result) {
  const PairResult& known = answer.result;
  const WaypointSpan span = result.span;
  const double start = bodies.times()[span.first], length = bodies.times()[span.last] - start;
  const SpanPoses X_WA(bodies, result.body_a, span), X_WB(bodies, result.body_b, span);
  const auto time = [&](double share) { return start + share * length; };
  const auto placed = [&](ContactPoint point) {
    point.enter = time(point.enter);
    point.exit = time(point.exit);
    point.time = time(point.time);
    const Isometry3d X = X_WA.at(point.time);
    point.p_W = X * point.p_W;
    point.normal_W = X.linear() * point.normal_W;
    return point;
  };
  // Depths and times are those of the pose; errors contain that of the pose, which may be another one now.
  const double more = error + RestingAnswers::kMoved - answer.error;
  const auto deepest = [&](const ContactPoint& point) {
    ContactPoint now = placed(point);
    if (known.measured) now.depth_error = std::max(error, now.depth_error + more);
    return now;
  };
  result.verdict = known.verdict;
  result.reason = known.reason;
  result.error = known.error;
  result.error.chord = std::max(error, known.error.chord + more);
  result.contact_error = known.contact_error;
  if (known.contact_error.total() > 0.0) result.contact_error.chord = std::max(error, known.contact_error.chord + more);
  result.measured = known.measured;
  for (const Interval& interval : known.intervals)
    result.intervals.push_back({time(interval.enter), time(interval.exit)});
  if (!known.intervals.empty()) result.deepest = deepest(known.deepest);
  const auto timesOf = [&](const std::optional<Interval>& touch) {
    return touch ? std::make_optional(Interval{time(touch->enter), time(touch->exit)}) : std::nullopt;
  };
  result.first_touch = timesOf(known.first_touch);
  result.last_touch = timesOf(known.last_touch);
  const std::size_t points = std::min(known.points.size(), static_cast<std::size_t>(std::max(max_points, 0)));
  for (std::size_t i = 0; i < points; ++i) result.points.push_back(placed(known.points[i]));
  for (const ContactPoint& peak : known.peaks) result.peaks.push_back(deepest(peak));

  // The wrench is constant in the bodies' frames; its average is taken in the middle between recorded times.
  const Vector3d a_end = X_WA.at(time(1.0)).translation(), b_end = X_WB.at(time(1.0)).translation();
  for (std::size_t k = span.first; k < span.last; ++k) {
    const double from = bodies.times()[k], until = bodies.times()[k + 1], share = (until - from) / length;
    const Isometry3d X_A = X_WA.at(0.5 * (from + until)), X_B = X_WB.at(0.5 * (from + until));
    const auto add = [&](const Wrench& of_rest, const Vector3d& shift, Wrench& sum) {
      const Vector3d force = X_A.linear() * of_rest.force;
      sum += share * Wrench{force, X_A.linear() * of_rest.torque + shift.cross(force)};
    };
    add(known.on_a_W, X_A.translation() - a_end, result.on_a_W);
    add(known.on_b_W, X_B.translation() - b_end, result.on_b_W);
  }
}

}  // namespace sdf_ccd
