#include "surface_contacts.h"

#include <algorithm>
#include <optional>

#include "crossing_intervals.h"
#include "pair_result.h"
#include "scene/pair_bound.h"

namespace sdf_ccd {

void SurfaceContacts::add(ContactPoint crossing) {
  std::vector<Interval>& intervals = result_.intervals;
  const std::size_t of_points = intervals.size();
  if (crossing.enter < crossing.exit) {
    intervals.assign(1, {crossing.enter, crossing.exit});
    if (of_points > 0) {
      setTimes(intervals, result_.deepest);
      result_.peaks.assign(1, result_.deepest);
    }
  }
  setTimes(intervals, crossing);
  if (of_points == 0) result_.deepest = crossing;
  if (intervals.size() > of_points) result_.peaks.push_back(crossing);
  addCrossings(surfaces_, motion_error_, memory_, intervals, result_.peaks);
  // Points that only touch, and crossings between points, do not tell how deep the bodies are.
  if (!(result_.deepest.depth > 0.0)) boundHiddenDepth(result_.deepest);
  for (ContactPoint& peak : result_.peaks)
    if (!(peak.depth > 0.0)) boundHiddenDepth(peak);
}

void SurfaceContacts::completePeaks() {
  for (std::size_t i = 0; i < result_.intervals.size(); ++i) {
    const Interval interval = result_.intervals[i];
    if (deepestWithin(result_, interval)) continue;
    for (const double time : {interval.exit, 0.5 * (interval.enter + interval.exit), interval.enter}) {
      const std::optional<ContactPoint> crossing = surfaces_.crossingAt(time, motion_error_, memory_);
      if (!crossing) continue;
      result_.peaks.push_back(*crossing);
      boundHiddenDepth(result_.peaks.back());
      break;
    }
  }
}

void SurfaceContacts::boundHiddenDepth(ContactPoint& point) const {
  const ErrorSources& error = result_.contact_error;
  double hidden = error.field + error.chord + error.root + hiddenDepth(scene_, pair_);
  if (result_.refined) hidden = std::min(hidden, result_.deepest.depth + result_.deepest.depth_error);
  setTimes(result_.intervals, point);
  point.depth = 0.0;  // not −0
  point.depth_error = std::max(point.depth_error, hidden);
}

}  // namespace sdf_ccd
