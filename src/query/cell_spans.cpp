#include "cell_spans.h"

#include <algorithm>

#include "cell_cubic.h"
#include "representation_queries.h"

namespace sdf_ccd {

void passOneSided(double t, double t_exit, bool inside, GridWalk& walk, Intervals& intervals) {
  if (inside) appendSpan(intervals, walk.t(), std::min(std::max(t, t_exit), walk.end()));
  if (t > t_exit) {
    walk.skipTo(t);
  } else {
    walk.advance();
  }
}

void appendCellSpans(const std::array<double, 8>& corners, const GridWalk& walk, const WalkedCell& cell, double sigma,
                     Intervals& intervals) {
  // The corners bound the cell exactly.
  const auto [low, high] = std::minmax_element(corners.begin(), corners.end());
  if (*low > sigma) return;
  if (*high <= sigma) {
    appendSpan(intervals, walk.t(), cell.t_exit);
    return;
  }
  const auto local = [&](double t) {
    return Vector3d((walk.local(t, cell.low) / cell.side).array().max(0.0).min(1.0));
  };
  const CellIntervals found = nonPositive(cellCubic(corners, local(walk.t()), local(cell.t_exit), sigma));
  const double length = cell.t_exit - walk.t();
  for (int i = 0; i < found.count; ++i) {
    const Interval& span = found.interval[i];
    const double exit = span.exit == 1.0 ? cell.t_exit : walk.t() + span.exit * length;
    appendSpan(intervals, walk.t() + span.enter * length, exit);
  }
}

}  // namespace sdf_ccd
