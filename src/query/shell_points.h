#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/segments.h"
#include "shell/point_shell.h"
#include "shell_query.h"

namespace sdf_ccd {

/// A shell point's path on a chord.
inline Segment along(const Chord& chord, const Vector3d& p_P) {
  return {chord.X_FP_start * p_P, chord.X_FP_end * p_P};
}

/// Queries points for their intervals; on grids in batches, which are faster.
class ShellPoints {
 public:
  ShellPoints(const DistanceField& field, const PointShell& shell, ShellQueryResult& result)
      : field_(field), shell_(shell), result_(result), work_(threadWork()), batched_(!field.primitive()) {}

  /// Sets the chord of the points that follow.
  void begin(const Chord& chord, int index) {
    chord_ = &chord;
    index_ = index;
    work_.points.clear();
    work_.segments.clear();
  }

  void query(std::int32_t point) {
    ++result_.points_tested;
    const Segment segment = along(*chord_, shell_.point(static_cast<std::size_t>(point)));
    if (!batched_) return querySingly(point, segment);
    work_.points.push_back(point);
    work_.segments.push_back(segment);
    if (work_.points.size() == kMaxPoints) finish();
  }

  /// Queries the points collected so far.
  void finish() {
    if (work_.points.empty()) return;
    segmentIntervals(field_, work_.segments.data(), work_.segments.size(), {}, work_.found);
    for (const SegmentHit& hit : work_.found.hits) {
      result_.hits.push_back({work_.points[hit.segment], index_, {double(hit.enter), double(hit.exit)}});
    }
    work_.points.clear();
    work_.segments.clear();
  }

 private:
  static constexpr std::size_t kMaxPoints = 16384;

  struct Work {
    std::vector<int> points;
    std::vector<Segment> segments;
    BatchResult found;
    Intervals intervals;
  };

  /// Kept per thread, so that steady-state queries allocate nothing.
  static Work& threadWork() {
    thread_local Work work;
    return work;
  }

  void querySingly(std::int32_t point, const Segment& segment) {
    segmentIntervals(field_, segment, {}, work_.intervals);
    for (const Interval& interval : work_.intervals) result_.hits.push_back({point, index_, interval});
  }

  const DistanceField& field_;
  const PointShell& shell_;
  ShellQueryResult& result_;
  Work& work_;
  const bool batched_;
  const Chord* chord_ = nullptr;
  int index_ = 0;
};

}  // namespace sdf_ccd
