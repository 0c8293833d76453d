#pragma once

#include <cmath>

#include "cell_spans.h"
#include "field/adaptive/adaptive_grid.h"
#include "grid_walk.h"

namespace sdf_ccd {

/// Follows a segment through an adaptive grid, in units.
inline GridWalk walkThrough(const AdaptiveGrid& grid, const Segment& segment) {
  return {{grid.shape().origin, grid.shape().unit(), grid.shape().units()}, segment};
}

/// A far block's empty sphere, reduced so that |φ| exceeds `margin` [m] in all of it; and a little more, as the sphere
/// is in metres and the walk in units.
inline EmptyBall emptySphere(const AdaptiveGrid& grid, const AdaptiveBlock& block, double margin) {
  const AdaptiveShape& shape = grid.shape();
  return {shape.origin + shape.unit() * block.ball_center, (block.ball_radius - margin) * (1.0 - 1e-9), block.inside};
}

}  // namespace sdf_ccd
