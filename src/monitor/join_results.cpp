#include "monitor/join_results.h"

#include <algorithm>
#include <cmath>

#include "common/infinity.h"
#include "pair_result.h"
#include "summarise.h"

namespace sdf_ccd {
namespace {

constexpr double kAtEnd = 1e-9;  // relative to a piece: an interval this close to its end continues in the next piece

ContactPoint later(ContactPoint point, double start) {
  point.enter += start;
  point.exit += start;
  point.time += start;
  return point;
}

/// The wrench about another origin. @param shift  from the new origin to the old one.
Wrench shifted(Wrench wrench, const Vector3d& shift) {
  wrench.torque += shift.cross(wrench.force);
  return wrench;
}

/// Of the peaks of the pieces, keeps that of each interval.
void keepHighest(PairResult& pair) {
  std::vector<ContactPoint> highest;
  for (const Interval& interval : pair.intervals) {
    if (const ContactPoint* peak = deepestPeak(pair, interval)) highest.push_back(*peak);
  }
  pair.peaks = std::move(highest);
}

}  // namespace

void ResultJoiner::add(const CycleMotion& motion, const CycleResult& result) {
  const bool is_first = ends_.times.empty();
  if (is_first) {
    ends_.times = {0.0, 0.0};
    for (const std::vector<Isometry3d>& poses : motion.X_WB) {
      const Isometry3d X_WB = poses.empty() ? Isometry3d::Identity() : poses.front();
      ends_.X_WB.push_back({X_WB, X_WB});
    }
    joined_.pairs.resize(result.pairs.size());
    known_.resize(result.pairs.size());
    for (std::size_t i = 0; i < result.pairs.size(); ++i) {
      PairResult& pair = joined_.pairs[i];
      pair.body_a = result.pairs[i].body_a;
      pair.body_b = result.pairs[i].body_b;
      pair.verdict = Verdict::kClear;
      pair.skipped = true;
      pair.span = {0, 1};
    }
  }
  for (std::size_t i = 0; i < result.pairs.size(); ++i) addPair(motion, result.pairs[i], joined_.pairs[i], known_[i]);
  for (std::size_t body = 0; body < motion.X_WB.size(); ++body) {
    if (!motion.X_WB[body].empty()) ends_.X_WB[body][1] = motion.X_WB[body].back();
  }
  ends_.times[1] += motion.times.back();
  joined_.run_time += result.run_time;
}

void ResultJoiner::addPair(const CycleMotion& motion, const PairResult& piece, PairResult& pair, Known& known) const {
  const double start = ends_.times[1], length = motion.times.back();
  pair.verdict = worseOf(pair.verdict, piece.verdict);
  if (pair.reason.empty()) pair.reason = piece.reason;
  if (piece.error.total() > pair.error.total()) pair.error = piece.error;
  if (piece.contact_error.total() > pair.contact_error.total()) pair.contact_error = piece.contact_error;
  pair.skipped &= piece.skipped;
  pair.clearance = piece.clearance;
  if (!piece.intervals.empty() && (pair.intervals.empty() || isDeeper(piece.deepest, pair.deepest)))
    pair.deepest = later(piece.deepest, start);
  addFirstTouch(start, piece, pair, known);
  addLastTouch(start, length, piece, pair);
  pair.measured |= piece.measured;
  if (!piece.intervals.empty() && (piece.measured || piece.deepest.depth > 0.0)) {
    known.reach = std::max(known.reach, piece.deepest.depth + piece.deepest.depth_error);
  } else if (piece.intervals.empty() && piece.verdict == Verdict::kUncertain) {
    known.near = std::max(known.near, piece.error.total() + margin_);
  }
  for (const Interval& interval : piece.intervals) {
    const bool goes_on = !pair.intervals.empty() && interval.enter <= kAtEnd * length &&
                         pair.intervals.back().exit >= start - kAtEnd * length;
    if (goes_on) {
      pair.intervals.back().exit = start + interval.exit;
    } else {
      pair.intervals.push_back({start + interval.enter, start + interval.exit});
    }
  }
  for (const ContactPoint& peak : piece.peaks) pair.peaks.push_back(later(peak, start));
  for (const ContactPoint& point : piece.points) pair.points.push_back(later(point, start));
  std::stable_sort(pair.points.begin(), pair.points.end(),
                   [](const ContactPoint& a, const ContactPoint& b) { return a.depth > b.depth; });
  pair.points.resize(std::min(pair.points.size(), static_cast<std::size_t>(std::max(max_points_, 0))));
  pair.on_a_W = shifted(pair.on_a_W, shift(pair.body_a, motion));
  pair.on_b_W = shifted(pair.on_b_W, shift(pair.body_b, motion));
  pair.on_a_W += length * piece.on_a_W;
  pair.on_b_W += length * piece.on_b_W;
}

/// A piece that is not CLEAR and has no first touch may touch from its start on.
void ResultJoiner::addFirstTouch(double start, const PairResult& piece, PairResult& pair, Known& known) {
  const std::optional<Interval>& touch = piece.first_touch;
  if (!known.apart_until && piece.verdict != Verdict::kClear) known.apart_until = start + (touch ? touch->enter : 0.0);
  const bool is_known = pair.first_touch && std::isfinite(pair.first_touch->exit);
  if (touch && !is_known) pair.first_touch = Interval{known.apart_until.value_or(start), start + touch->exit};
}

/// A piece that is not CLEAR and has no last touch may touch up to its end.
void ResultJoiner::addLastTouch(double start, double length, const PairResult& piece, PairResult& pair) {
  if (piece.verdict == Verdict::kClear) return;
  const Interval touch = piece.last_touch.value_or(Interval{-kInfinity, length});
  const double known = pair.last_touch ? pair.last_touch->enter : -kInfinity;
  pair.last_touch = Interval{std::max(known, start + touch.enter), start + touch.exit};
}

/// From the body's origin at the end of this piece to that at its start.
Vector3d ResultJoiner::shift(int body, const CycleMotion& motion) const {
  const std::vector<Isometry3d>& poses = motion.X_WB[body];
  if (poses.empty()) return Vector3d::Zero();
  return ends_.X_WB[body][1].translation() - poses.back().translation();
}

CycleResult ResultJoiner::result() const {
  CycleResult result = joined_;
  for (std::size_t i = 0; i < result.pairs.size(); ++i) {
    PairResult& pair = result.pairs[i];
    const double reach = std::max(known_[i].reach, pair.measured ? known_[i].near : 0.0);
    pair.deepest.depth_error = std::max(pair.deepest.depth_error, reach - pair.deepest.depth);
    keepHighest(pair);
    if (!pair.measured) pair.last_touch.reset();
    if (pair.verdict != Verdict::kNotChecked && !pair.on_a_W.force.hasNaN()) pair.reason.clear();
    pair.on_a_W = 1.0 / ends_.times[1] * pair.on_a_W;
    pair.on_b_W = 1.0 / ends_.times[1] * pair.on_b_W;
  }
  summarise(result);
  return result;
}

}  // namespace sdf_ccd
