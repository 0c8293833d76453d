#include "pair_measure.h"

#include <algorithm>

#include "crossing_intervals.h"
#include "pair_result.h"
#include "scene/pair_bound.h"

namespace sdf_ccd {

PairMeasure::PairMeasure(const Body& a, const Body& b, const PlannedPair& pair, double resolution)
    : greatest_depth_(std::max(sdf_ccd::greatestDepth(a), sdf_ccd::greatestDepth(b))),
      hidden_depth_(hiddenDepth(a, b, pair)) {
  if (haveSurfaces(a, b) && ContactRefinement::isPossible(a, b)) refinement_.emplace(a, b, resolution);
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

void PairMeasure::complete(const PairCycle& cycle, SurfacePair& surfaces, PairResult& result) const {
  if (cycle.request.refine == Refinement::kDeepest && refinement_) refinement_->run(cycle, surfaces, result);
  for (std::size_t i = 0; i < result.intervals.size(); ++i) {
    const Interval interval = result.intervals[i];
    if (deepestWithin(result, interval)) continue;
    for (const double time : {interval.exit, 0.5 * (interval.enter + interval.exit), interval.enter}) {
      const std::optional<ContactPoint> crossing =
          surfaces.crossingAt(time, result.error.chord, cycle.memory.separation);
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
  if (result.refined) hidden = std::min(hidden, result.deepest.depth + result.deepest.depth_error);
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
