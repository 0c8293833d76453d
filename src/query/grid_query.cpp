#include <algorithm>
#include <cmath>

#include "cell_spans.h"
#include "grid_walk.h"
#include "representation_queries.h"

namespace sdf_ccd {
namespace {

constexpr int kBrick = GridShape::kBrick;

enum class Side { kOutside, kInside, kBoth };

Side sideOf(const DistanceRange& range, double sigma) {
  if (range.min > sigma) return Side::kOutside;
  return range.max <= sigma ? Side::kInside : Side::kBoth;
}

}  // namespace

void gridIntervals(const SparseGrid& grid, const Segment& segment, const SegmentOptions& options,
                   Intervals& intervals) {
  const double sigma = options.sigma;
  GridWalk walk({grid.shape().origin, grid.shape().cell, grid.shape().cells()}, segment);
  const auto firstFound = [&] {
    return options.first_only && !intervals.empty() && walk.t() > intervals.front().exit + kJoin;
  };
  while (walk.inside() && !firstFound()) {
    const Vector3i brick = walk.cell() / kBrick;
    const Side side = sideOf(grid.range(0, brick), sigma);
    if (side != Side::kBoth) {
      // The largest block around it that lies on one side (paper §3.2).
      int level = 0;
      while (level + 1 < grid.levels() && sideOf(grid.range(level + 1, brick / (2 << level)), sigma) == side) ++level;
      const int bricks = 1 << level;
      const Vector3i low = (brick / bricks) * bricks * kBrick;
      const Vector3i high = (low.array() + bricks * kBrick).min(grid.shape().cells().array());
      const double t_exit = walk.exit(low, high);
      if (side == Side::kInside) appendSpan(intervals, walk.t(), t_exit);
      walk.advance();
      continue;
    }
    const std::int32_t slot = grid.slot(brick);
    const Vector3i first = kBrick * brick;
    while (walk.inside() && walk.cell() / kBrick == brick && !firstFound()) {
      const double t_exit = walk.exit(walk.cell(), walk.cell().array() + 1);
      appendCellSpans(grid.cellCorners(slot, walk.cell() - first), walk, {walk.cell(), 1, t_exit}, sigma, intervals);
      walk.advance();
    }
  }
  if (options.first_only && intervals.size() > 1) intervals.resize(1);
}

void gridPieces(const SparseGrid& grid, const Segment& segment, const Interval& interval, std::vector<double>& breaks) {
  const GridShape& shape = grid.shape();
  for (int k = 0; k < 3; ++k) {
    const double start = (segment.start[k] - shape.origin[k]) / shape.cell;
    const double step = (segment.end[k] - segment.start[k]) / shape.cell;
    if (step == 0.0) continue;
    const double a = start + interval.enter * step, b = start + interval.exit * step;
    const double low = std::max(std::ceil(std::min(a, b)), 0.0);
    const double high = std::min(std::floor(std::max(a, b)), double(shape.cells()[k]));
    for (double plane = low; plane <= high; plane += 1.0) {
      const double t = (plane - start) / step;
      if (t > interval.enter && t < interval.exit) breaks.push_back(t);
    }
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end()), breaks.end());
}

}  // namespace sdf_ccd
