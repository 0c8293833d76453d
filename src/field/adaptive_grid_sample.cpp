#include "grid_sample.h"

#include <limits>

namespace sdf_ccd {
namespace {

/// The block that holds a place of the grid's box, and the place in it, [0, 1]³.
struct LocatedBlock {
  AdaptiveBlock block;
  Vector3d u;
};

LocatedBlock locate(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const AdaptiveShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.unit();
  const Vector3i last = shape.units().array() - 1;
  const AdaptiveBlock block = grid.block(g.array().floor().max(0.0).matrix().cast<int>().cwiseMin(last));
  const Vector3d u = (g - block.low.cast<double>()) / block.side;
  return {block, u.array().max(0.0).min(1.0)};
}

/// What a far block's distance was rounded down by, at most [m].
double farRounding(const AdaptiveGrid& grid, const AdaptiveBlock& block) {
  for (int depth = 0; depth < AdaptiveShape::kMaxDepth; ++depth) {
    if (block.side == AdaptiveShape::kUnits >> (2 * depth + 2)) return grid.farStep(depth);
  }
  return std::abs(block.distance) * 1e-5;
}

/// Of the distance in a far block, from that at its centre.
DistanceBounds farBounds(const AdaptiveGrid& grid, const LocatedBlock& at) {
  const AdaptiveShape& shape = grid.shape();
  const double away = (at.u.array() - 0.5).matrix().norm() * at.block.side * shape.unit();
  const double rounding = farRounding(grid, at.block);
  if (at.block.distance < 0.0) {
    return {at.block.distance - rounding - away, std::min(at.block.distance + away, -shape.band)};
  }
  return {std::max(at.block.distance - away, shape.band), at.block.distance + rounding + away};
}

/// The distance at the centre of a top cell, and its error [m].
FieldSample centerSample(const AdaptiveGrid& grid, const Vector3i& cell) {
  const Vector3i unit = AdaptiveShape::kUnits * cell.array() + AdaptiveShape::kUnits / 2;
  const AdaptiveBlock block = grid.block(unit);
  if (block.leaf) {
    const Vector3d u = (unit - block.low).cast<double>() / block.side;
    return {trilinear(grid.corners(block), u), grid.shape().error_bound, Vector3d::Zero()};
  }
  const DistanceBounds bounds = farBounds(grid, {block, (unit - block.low).cast<double>() / block.side});
  return {0.5 * (bounds.low + bounds.high), 0.5 * (bounds.high - bounds.low), Vector3d::Zero()};
}

/// Far from the surface: interpolated between the centres of the top cells, within what the block's centre says.
FieldSample farSample(const AdaptiveGrid& grid, const LocatedBlock& at, const Vector3d& p_F) {
  const AdaptiveShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.cell - Vector3d::Constant(0.5);
  const Vector3i low =
      g.array().floor().max(0.0).matrix().cast<int>().cwiseMin((shape.size.array() - 2).max(0).matrix());
  const Vector3d u = (g - low.cast<double>()).array().max(0.0).min(1.0);
  std::array<double, 8> corners;
  double error = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Vector3i cell = (low + Vector3i(k & 1, (k >> 1) & 1, k >> 2)).cwiseMin((shape.size.array() - 1).matrix());
    const FieldSample center = centerSample(grid, cell);
    corners[k] = center.value;
    error = std::max(error, center.error);
  }
  const DistanceBounds bounds = farBounds(grid, at);
  const double value = std::clamp(trilinear(corners, u), bounds.low, bounds.high);
  const double beyond = (g - low.cast<double>() - u).norm() * shape.cell;
  error = std::min(error + lipschitzError(u, shape.cell) + beyond, std::max(bounds.high - value, value - bounds.low));
  return {value, error, trilinearGradient(corners, u) / shape.cell};
}

}  // namespace

DistanceBounds gridBounds(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const AdaptiveShape& shape = grid.shape();
  const double to_surface_box = shape.surface_box.exteriorDistance(p_F);
  if (!shape.box().contains(p_F)) return {to_surface_box, std::numeric_limits<double>::infinity()};
  const LocatedBlock at = locate(grid, p_F);
  DistanceBounds bounds{};
  if (at.block.leaf) {
    const double value = trilinear(grid.corners(at.block), at.u);
    bounds = {value - shape.error_bound, value + shape.error_bound};
  } else {
    bounds = farBounds(grid, at);
  }
  // Inside the surface's box a point may be inside the body, so the distance to the box says nothing there.
  if (to_surface_box > 0.0) bounds.low = std::max(bounds.low, to_surface_box);
  return bounds;
}

FieldSample gridSample(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const AdaptiveShape& shape = grid.shape();
  const AlignedBox3d box = shape.box();
  const Vector3d q = p_F.cwiseMax(box.min()).cwiseMin(box.max());
  const LocatedBlock at = locate(grid, q);
  FieldSample sample;
  if (at.block.leaf) {
    const std::array<double, 8> corners = grid.corners(at.block);
    sample = {trilinear(corners, at.u), shape.error_bound,
              trilinearGradient(corners, at.u) / (at.block.side * shape.unit())};
  } else {
    sample = farSample(grid, at, q);
  }
  return q == p_F ? sample : outsideSample(shape.surface_box, p_F, q, sample);
}

}  // namespace sdf_ccd
