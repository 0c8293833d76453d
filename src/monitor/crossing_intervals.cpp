#include "crossing_intervals.h"

#include <algorithm>
#include <optional>

#include "query/smooth_pieces.h"

namespace sdf_ccd {
namespace {

constexpr int kTimes = 4;                 // parts of a gap, at whose ends crossings are looked for
constexpr std::size_t kMaxIntervals = 8;  // where there are more, in the middle of the gaps between them only
constexpr std::size_t kMaxGaps = 100;     // of which about so many are tested, evenly
constexpr double kNoGap = 1e-9;           // of the span; shorter gaps are none

class Gap {
 public:
  /// @param times    number of parts.
  /// @param crosses  whether the surfaces certainly cross at a time.
  template <class Crosses>
  Gap(const Interval& gap, bool touches_before, bool touches_after, int times, const Crosses& crosses) {
    const auto at = [&](int i) {
      return i == times ? gap.exit : gap.enter + (gap.exit - gap.enter) * i / double(times);
    };
    const auto touches = [&](int i) {
      return (i == 0 && touches_before) || (i == times && touches_after) || crosses(at(i));
    };
    int first = 0;  // not known to touch
    while (first <= times && touches(first)) ++first;
    int last = times;
    while (last > first && touches(last)) --last;
    is_closed_ = first > times;
    if (first > 0) before_ = Interval{gap.enter, at(first - 1)};
    if (first <= times && last < times) after_ = Interval{at(last + 1), gap.exit};
  }

  /// Whether the surfaces cross all the time, as far as tested.
  bool isClosed() const { return is_closed_; }

  void addTo(std::vector<Interval>& intervals) const {
    if (before_) intervals.push_back(*before_);
    if (after_) intervals.push_back(*after_);
  }

 private:
  bool is_closed_ = false;
  std::optional<Interval> before_, after_;  // parts at its begin and end during which the surfaces cross
};

}  // namespace

void addCrossings(SurfacePair& surfaces, double motion_error, SeparationMemory& memory,
                  std::vector<Interval>& intervals, std::vector<ContactPoint>& crossings) {
  const RelativeMotion& motion = surfaces.motion();
  const double start = motion.startTime(), end = motion.endTime();
  const auto crosses = [&](double time) {
    const std::optional<ContactPoint> crossing = surfaces.crossingAt(time, motion_error, memory);
    if (crossing) crossings.push_back(*crossing);
    return crossing.has_value();
  };
  const std::size_t known = intervals.size(), stride = known / kMaxGaps + 1;
  const auto gapAt = [&](std::size_t i) {
    return Interval{i == 0 ? start : intervals[i - 1].exit, i == known ? end : intervals[i].enter};
  };
  std::optional<std::size_t> closed;  // the last gap that was tested, if it is closed
  for (std::size_t i = 0; i <= known; ++i) {
    const bool is_between = i > 0 && i < known;
    if (is_between && i % stride != 0) continue;
    const Interval gap = gapAt(i);
    bool is_closed = true;
    if (gap.exit - gap.enter > kNoGap * (end - start)) {
      const Gap tested(gap, i > 0, i < known, is_between && known > kMaxIntervals ? 2 : kTimes, crosses);
      tested.addTo(intervals);
      is_closed = tested.isClosed();
    }
    // Those between two that are closed are taken to be closed as well.
    for (std::size_t k = closed.value_or(i) + 1; is_closed && k < i; ++k) intervals.push_back(gapAt(k));
    closed = is_closed ? std::make_optional(i) : std::nullopt;
  }
  mergeIntervals(intervals, kNoGap * (end - start));
}

}  // namespace sdf_ccd
