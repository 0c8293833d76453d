#include "cell_spans.h"

#include <algorithm>

#include "query/representation_queries.h"

namespace sdf_ccd {

void passTo(double t, bool inside, GridWalk& walk, Intervals& intervals) {
  if (inside) appendSpan(intervals, walk.t(), std::min(t, walk.end()));
  walk.skipTo(t);
}

void passFree(const Vector3i& low, int side, const EmptyBall& ball, const BallExit& ball_exit, GridWalk& walk,
              Intervals& intervals) {
  // A sphere that contains the block is left after the block, except by a segment of zero length.
  const CellLattice& lattice = walk.lattice();
  const double half = 0.5 * side * lattice.cell;
  const Vector3d center = lattice.origin + lattice.cell * low.cast<double>() + Vector3d::Constant(half);
  const Vector3d farthest_corner = (center - ball.center).array().abs() + half;
  if (ball.radius > farthest_corner.norm() * (1.0 + 1e-9)) {
    const double t = ball_exit(ball.center, ball.radius, walk.t());
    if (t > walk.t()) return passTo(t, ball.inside, walk, intervals);
  }
  const double t_exit = walk.exit(low, low.array() + side);
  const double t = ball_exit(ball.center, ball.radius, t_exit);
  if (t > t_exit) return passTo(t, ball.inside, walk, intervals);
  if (ball.inside) appendSpan(intervals, walk.t(), t_exit);
  walk.advance();
}

CellCubic cubicAlong(const std::array<double, 8>& corners, const GridWalk& walk, const WalkedCell& cell, double sigma) {
  const auto local = [&](double t) {
    return Vector3d((walk.local(t, cell.low) / cell.side).array().max(0.0).min(1.0));
  };
  return cellCubic(corners, local(walk.t()), local(cell.t_exit), sigma);
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
  const CellIntervals found = nonPositive(cubicAlong(corners, walk, cell, sigma));
  const double length = cell.t_exit - walk.t();
  for (int i = 0; i < found.count; ++i) {
    const Interval& span = found.interval[i];
    const double exit = span.exit == 1.0 ? cell.t_exit : walk.t() + span.exit * length;
    appendSpan(intervals, walk.t() + span.enter * length, exit);
  }
}

}  // namespace sdf_ccd
