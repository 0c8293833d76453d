#include "pair_result.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "query/smooth_pieces.h"

namespace sdf_ccd {

void clear(PairResult& result) {
  result.verdict = Verdict::kNotChecked;
  result.reason.clear();
  result.skipped = result.postponed = result.incomplete = false;
  result.error = result.contact_error = {};
  result.clearance = -1.0;
  result.intervals.clear();
  result.deepest = {};
  result.measured = false;
  result.first_touch.reset();
  result.last_touch.reset();
  result.on_a_W = {};
  result.on_b_W = {};
  result.points.clear();
  result.peaks.clear();
}

void requireFinite(const ErrorSources& error) {
  if (!std::isfinite(error.total())) throw std::runtime_error("its error bound is not finite");
}

void setClear(double clearance, PairResult& result) {
  result.verdict = Verdict::kClear;
  result.clearance = clearance - result.error.chord;
}

void setSkipped(const ErrorSources& error, PairResult& result) {
  clear(result);
  result.verdict = Verdict::kClear;
  result.skipped = true;
  result.error = error;
  result.clearance = 0.0;
}

bool isTimed(const PairResult& pair) {
  return !pair.incomplete || !pair.on_a_W.force.hasNaN();
}

void setWrenchesUnknown(PairResult& result) {
  for (Wrench* wrench : {&result.on_a_W, &result.on_b_W})
    wrench->force = wrench->torque = Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
}

bool isWithin(const ContactPoint& point, const Interval& interval) {
  return interval.enter <= point.time && point.time <= interval.exit;
}

bool isDeeper(const ContactPoint& a, const ContactPoint& b) {
  return std::tie(a.depth, a.depth_error) > std::tie(b.depth, b.depth_error);
}

const ContactPoint* deepestPeak(const PairResult& pair, const Interval& interval) {
  const ContactPoint* deepest = nullptr;
  for (const ContactPoint& peak : pair.peaks)
    if (isWithin(peak, interval) && (!deepest || isDeeper(peak, *deepest))) deepest = &peak;
  return deepest;
}

const ContactPoint* deepestWithin(const PairResult& pair, const Interval& interval) {
  const ContactPoint* peak = deepestPeak(pair, interval);
  const bool is_of_all = isWithin(pair.deepest, interval) && (!peak || !isDeeper(*peak, pair.deepest));
  return is_of_all ? &pair.deepest : peak;
}

void setTimes(std::vector<Interval>& intervals, ContactPoint& point) {
  for (const Interval& interval : intervals) {
    if (!isWithin(point, interval)) continue;
    point.enter = interval.enter;
    point.exit = interval.exit;
    return;
  }
  point.enter = point.exit = point.time;
  intervals.push_back({point.time, point.time});
  mergeIntervals(intervals, 0.0);
}

void setNotChecked(const std::string& reason, PairResult& result) {
  result.verdict = Verdict::kNotChecked;
  result.reason = reason;
}

bool holdsSample(const Interval& interval, const std::vector<double>& samples) {
  const auto first = std::lower_bound(samples.begin(), samples.end(), interval.enter);
  return first != samples.end() && *first <= interval.exit;
}

}  // namespace sdf_ccd
