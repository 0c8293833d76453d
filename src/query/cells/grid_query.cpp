#include <algorithm>
#include <cmath>
#include <limits>

#include "ball_exit.h"
#include "cell_spans.h"
#include "grid_walk.h"
#include "query/representation_queries.h"

namespace sdf_ccd {
namespace {

constexpr int kBrick = GridShape::kBrick;

/// The empty sphere of a far brick.
EmptyBall brickBall(const SparseGrid& grid, const Vector3i& brick, const EmptySphere& ball, double sigma) {
  const GridShape& shape = grid.shape();
  return {shape.origin + kBrick * shape.cell * (brick + ball.offset).cast<double>(),
          ball.steps * grid.ballStep() - std::abs(sigma) - grid.errorBound(), ball.inside};
}

/// The sphere about the sample nearest to a point of a sampled brick. With v the sample and h the cell no point within
/// √((v − σ)² − ¾h²) can be interpolated to σ (design §3.3); v is reduced by the samples' rounding.
EmptyBall sampleBall(const SparseGrid& grid, const Vector3i& brick, std::int32_t slot, const Vector3d& p_F,
                     double sigma) {
  const GridShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.cell - (kBrick * brick).cast<double>();
  const Vector3i i = (g.array() + 0.5).floor().max(0.0).min(double(kBrick)).matrix().cast<int>();
  const double above = grid.sample(slot, i) - sigma;
  const double free =
      std::abs(above) * (1.0 - 1e-6) - 2.0 * grid.rounding() - std::numeric_limits<float>::epsilon() * std::abs(sigma);
  const double radius2 = std::max(free, 0.0) * free - 0.75 * shape.cell * shape.cell;
  return {shape.origin + shape.cell * (kBrick * brick + i).cast<double>(), radius2 > 0.0 ? std::sqrt(radius2) : 0.0,
          above < 0.0};
}

}  // namespace

void gridIntervals(const SparseGrid& grid, const Segment& segment, const SegmentOptions& options,
                   Intervals& intervals) {
  const double sigma = options.sigma;
  GridWalk walk({grid.shape().origin, grid.shape().cell, grid.shape().cells()}, segment);
  const BallExit ball_exit(segment);
  while (walk.inside()) {
    const Vector3i brick = walk.cell() / kBrick;
    const std::uint32_t word = grid.word(brick);
    if (brick_word::isFar(word)) {
      const EmptyBall ball = brickBall(grid, brick, EmptySphere::of(word), sigma);
      passFree(kBrick * brick, kBrick, ball, ball_exit, walk, intervals);
    } else {
      const std::int32_t slot = grid.slot(brick);
      const Vector3d point = segment.start + walk.t() * (segment.end - segment.start);
      const EmptyBall ball = sampleBall(grid, brick, slot, point, sigma);
      const double t_exit = walk.exit(walk.cell(), walk.cell().array() + 1);
      const double t_ball = ball_exit(ball.center, ball.radius, walk.t());
      if (t_ball > t_exit) {
        passTo(t_ball, ball.inside, walk, intervals);
      } else {
        const auto corners = grid.cellCorners(slot, walk.cell() - kBrick * brick);
        appendCellSpans(corners, walk, {walk.cell(), 1, t_exit}, sigma, intervals);
        walk.advance();
      }
    }
    if (isAnswered(options.mode, intervals, walk.t())) break;
  }
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
