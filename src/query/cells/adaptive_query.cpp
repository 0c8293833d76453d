#include <algorithm>
#include <cmath>

#include "adaptive_walk.h"
#include "query/representation_queries.h"

namespace sdf_ccd {

void adaptiveIntervals(const AdaptiveGrid& grid, const Segment& segment, const SegmentOptions& options,
                       Intervals& intervals) {
  const AdaptiveShape& shape = grid.shape();
  GridWalk walk = walkThrough(grid, segment);
  const BallExit ball_exit(segment);
  // Spheres are free of the true isosurface; leaves may place it nearer by their error.
  const double margin = std::abs(options.sigma) + shape.error_bound;
  while (walk.inside()) {
    const AdaptiveBlock block = grid.block(walk.cell());
    if (block.leaf) {
      const double t_exit = walk.exit(block.low, block.low.array() + block.side);
      // A leaf that is only touched at a corner is skipped: its neighbours' values there may differ.
      if (t_exit > walk.t()) {
        appendCellSpans(grid.corners(block), walk, {block.low, block.side, t_exit}, options.sigma, intervals);
      }
      walk.advance();
    } else {
      // All of the block is on one side, and so is the sphere about its centre that extends to the isosurface.
      const EmptyBall ball = emptySphere(grid, block, margin);
      passFree(block.low, block.side, ball, ball_exit, walk, intervals);
    }
    if (isAnswered(options.mode, intervals, walk.t())) break;
  }
}

void adaptivePieces(const AdaptiveGrid& grid, const Segment& segment, const Interval& interval,
                    std::vector<double>& breaks) {
  GridWalk walk = walkThrough(grid, segment);
  if (interval.enter > walk.t()) walk.skipTo(interval.enter);
  while (walk.inside() && walk.t() < interval.exit) {
    if (walk.t() > interval.enter) breaks.push_back(walk.t());
    const AdaptiveBlock block = grid.block(walk.cell());
    walk.exit(block.low, block.low.array() + block.side);
    walk.advance();
  }
}

}  // namespace sdf_ccd
