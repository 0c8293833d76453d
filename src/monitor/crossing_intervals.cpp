#include "crossing_intervals.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

constexpr int kTimes = 4;
constexpr std::size_t kMaxIntervals = 8;
constexpr double kRounding = 1e-9;  // of the span; shorter gaps are none

class Gap {
 public:
  /// @param crosses  whether the surfaces certainly cross at a time.
  template <class Crosses>
  Gap(const Interval& gap, bool touches_before, bool touches_after, const Crosses& crosses) {
    const auto at = [&](int i) {
      return i == kTimes ? gap.exit : gap.enter + (gap.exit - gap.enter) * i / double(kTimes);
    };
    int first = touches_before ? 1 : 0;  // not known to cross
    while (first <= kTimes && crosses(at(first))) ++first;
    int last = touches_after ? kTimes - 1 : kTimes;
    while (last > first && crosses(at(last))) --last;
    if (first > 0) before_ = Interval{gap.enter, at(first - 1)};
    if (first <= kTimes && last < kTimes) after_ = Interval{at(last + 1), gap.exit};
  }

  void addTo(std::vector<Interval>& intervals) const {
    if (before_) intervals.push_back(*before_);
    if (after_) intervals.push_back(*after_);
  }

 private:
  std::optional<Interval> before_, after_;  // parts at its begin and end during which the surfaces cross
};

}  // namespace

void addCrossings(SurfacePair& surfaces, double motion_error, SeparationMemory& memory,
                  std::vector<Interval>& intervals) {
  const RelativeMotion& motion = surfaces.motion();
  const double start = motion.motion(0).t_start, end = motion.motion(motion.steps() - 1).t_end;
  const auto crosses = [&](double time) { return surfaces.crossAt(time, motion_error, memory); };
  const std::size_t known = intervals.size();
  for (std::size_t i = 0; i <= known; ++i) {
    if (i > 0 && i < known && known > kMaxIntervals) continue;
    const Interval gap{i == 0 ? start : intervals[i - 1].exit, i == known ? end : intervals[i].enter};
    if (gap.exit - gap.enter <= kRounding * (end - start)) continue;
    Gap(gap, i > 0, i < known, crosses).addTo(intervals);
  }
  mergeIntervals(intervals, kRounding * (end - start));
}

}  // namespace sdf_ccd
