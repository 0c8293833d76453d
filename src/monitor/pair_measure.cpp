#include "pair_measure.h"

#include <algorithm>

#include "contact_times.h"
#include "crossing_intervals.h"
#include "pair_result.h"
#include "scene/pair_bound.h"

namespace sdf_ccd {

PairMeasure::PairMeasure(const Body& a, const Body& b, const PlannedPair& pair, double resolution)
    : greatest_depth_(std::max(sdf_ccd::greatestDepth(a), sdf_ccd::greatestDepth(b))),
      hidden_depth_(hiddenDepth(a, b, pair)) {
  if (haveSurfaces(a, b) && PairDepth::isPossible(a, b)) depth_.emplace(a, b, resolution);
}

void PairMeasure::addCrossing(ContactPoint crossing, SurfacePair& surfaces, SeparationMemory& memory,
                              PairResult& result) const {
  std::vector<Interval>& intervals = result.intervals;
  const std::size_t of_points = intervals.size();
  if (crossing.enter < crossing.exit) {
    intervals.assign(1, {crossing.enter, crossing.exit});
    if (of_points > 0) {
      setTimes(intervals, result.deepest);
      result.peaks.assign(1, result.deepest);
    }
  }
  setTimes(intervals, crossing);
  if (of_points == 0) result.deepest = crossing;
  if (intervals.size() > of_points) result.peaks.push_back(crossing);
  addCrossings(surfaces, result.error.chord, memory, intervals, result.peaks);
  // Points that only touch, and crossings between points, do not tell how deep the bodies are.
  if (!(result.deepest.depth > 0.0)) boundHiddenDepth(result.deepest, result);
  for (ContactPoint& peak : result.peaks)
    if (!(peak.depth > 0.0)) boundHiddenDepth(peak, result);
}

void PairMeasure::measure(const PairCycle& cycle, const std::optional<ContactPoint>& crossing, SurfacePair& surfaces,
                          PairResult& result) {
  const PairDepth::Found found = depth_->run(cycle.motionOf(result), result.error.chord, cycle.memory.depth);
  result.measured = true;
  result.intervals.clear();
  result.peaks.clear();
  result.deepest = {};
  if (!crossing && !(found.deepest.depth > 0.0)) return;
  if (found.deepest.depth > found.certain) result.verdict = Verdict::kContact;
  setContactTimes(surfaces, *depth_, found, crossing, cycle.memory.separation, cycle.memory.samples, result);
  result.deepest = found.deepest;
  // A search that ended early says less than the bodies' sizes.
  const double most = greatestDepth(surfaces, found.certain) - found.deepest.depth;
  result.deepest.depth_error = std::min(result.deepest.depth_error, std::max(most, found.certain));
  if (!(found.deepest.depth > 0.0)) {
    const double depth_error = result.deepest.depth_error;
    result.deepest = *crossing;
    result.deepest.depth_error = depth_error;
  }
  setTimes(result.intervals, result.deepest);
  result.peaks.push_back(result.deepest);
  if (result.intervals.size() > 1) addDeepestPoints(surfaces, cycle.memory.separation, result);
  const auto isOutside = [&](const ContactPoint& point) {
    return point.exit < result.intervals.front().enter || point.enter > result.intervals.back().exit;
  };
  result.points.erase(std::remove_if(result.points.begin(), result.points.end(), isOutside), result.points.end());
}

/// Of the intervals without one.
void PairMeasure::addDeepestPoints(SurfacePair& surfaces, SeparationMemory& memory, PairResult& result) {
  for (const Interval& interval : result.intervals) {
    if (isWithin(result.deepest, interval)) continue;
    ContactPoint point = depth_->deepestWithin(interval, result.error.chord);
    if (!(point.depth > 0.0)) {
      const double depth_error = point.depth_error;
      for (const double time : {0.5 * (interval.enter + interval.exit), interval.enter, interval.exit}) {
        const std::optional<ContactPoint> crossing = surfaces.crossingAt(time, result.error.chord, memory);
        if (crossing) point = *crossing;
        if (crossing) break;
      }
      point.time = std::clamp(point.time, interval.enter, interval.exit);
      point.depth_error = depth_error;
    }
    point.enter = interval.enter;
    point.exit = interval.exit;
    result.peaks.push_back(point);
  }
}

void PairMeasure::addPeaks(SurfacePair& surfaces, SeparationMemory& memory, PairResult& result) const {
  for (std::size_t i = 0; i < result.intervals.size(); ++i) {
    const Interval interval = result.intervals[i];
    if (deepestWithin(result, interval)) continue;
    for (const double time : {interval.exit, 0.5 * (interval.enter + interval.exit), interval.enter}) {
      const std::optional<ContactPoint> crossing = surfaces.crossingAt(time, result.error.chord, memory);
      if (!crossing) continue;
      result.peaks.push_back(*crossing);
      boundHiddenDepth(result.peaks.back(), result);
      break;
    }
  }
}

void PairMeasure::boundHiddenDepth(ContactPoint& point, PairResult& result) const {
  const ErrorSources& error = result.contact_error;
  double hidden = error.field + error.chord + error.root + hidden_depth_;
  setTimes(result.intervals, point);
  point.depth = 0.0;  // not −0
  point.depth_error = std::max(point.depth_error, hidden);
}

double PairMeasure::greatestDepth(const SurfacePair& surfaces, double error) const {
  if (!surfaces.isWithHalfSpace()) return error + greatest_depth_;
  const RelativeMotion& motion = surfaces.motion();
  return error + surfaces.deviation() + motion.travel() - surfaces.ballClearance(motion.start());
}

}  // namespace sdf_ccd
