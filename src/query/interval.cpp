#include "common/cancel_point.h"
#include "query/smooth_pieces.h"
#include "sdf_ccd/segments.h"

#include <algorithm>

namespace sdf_ccd {

void mergeIntervals(Intervals& intervals, double gap) {
  if (intervals.empty()) return;
  CancelTicks<1024> cancel;
  std::sort(intervals.begin(), intervals.end(), [&](const Interval& a, const Interval& b) {
    cancel.check();
    return a.enter < b.enter;
  });
  std::size_t last = 0;
  for (std::size_t i = 1; i < intervals.size(); ++i) {
    if (intervals[i].enter <= intervals[last].exit + gap) {
      intervals[last].exit = std::max(intervals[last].exit, intervals[i].exit);
    } else {
      intervals[++last] = intervals[i];
    }
  }
  intervals.resize(last + 1);
}

}  // namespace sdf_ccd
