#include "field/cube_corner.h"
#include "field/grid_cell.h"
#include "field/grid_sample.h"
#include "field/trilinear_cell.h"

namespace sdf_ccd {
namespace {

/// The block that holds a point of the grid's box, and the point in it, [0, 1]³.
struct LocatedBlock {
  AdaptiveBlock block;
  Vector3d u;
};

LocatedBlock locate(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const AdaptiveShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.unit();
  const AdaptiveBlock block = grid.block(cellAt(g, shape.units()));
  return {block, withinCell((g - block.low.cast<double>()) / block.side)};
}

FieldValue leafValue(const AdaptiveGrid& grid, const LocatedBlock& at) {
  const std::array<double, 8> corners = grid.corners(at.block);
  return {trilinear(corners, at.u), trilinearGradient(corners, at.u) / (at.block.side * grid.shape().unit())};
}

/// Bounds in a far block. |φ| is at least the distance to the surface of its empty sphere (and the band), and at most
/// the upper bound at the block's centre plus the distance from there.
DistanceBounds farBounds(const AdaptiveGrid& grid, const LocatedBlock& at) {
  const AdaptiveShape& shape = grid.shape();
  const Vector3d from_low = at.block.side * at.u, half = Vector3d::Constant(0.5 * at.block.side);
  const double away = (from_low - half).norm() * shape.unit();
  const double from_ball = (at.block.low.cast<double>() + from_low - at.block.ball_center).norm() * shape.unit();
  const double low = std::max(at.block.ball_radius - from_ball, shape.band), high = at.block.upper_bound + away;
  return at.block.inside ? DistanceBounds{-high, -low} : DistanceBounds{low, high};
}

/// The distance at the centre of a top cell, and its error [m].
FieldSample centerSample(const AdaptiveGrid& grid, const Vector3i& cell) {
  const Vector3i unit = AdaptiveShape::kUnits * cell.array() + AdaptiveShape::kUnits / 2;
  const AdaptiveBlock block = grid.block(unit);
  if (block.leaf) {
    const Vector3d u = (unit - block.low).cast<double>() / block.side;
    return {trilinear(grid.corners(block), u), grid.leafError(block), Vector3d::Zero()};
  }
  const DistanceBounds bounds = farBounds(grid, {block, (unit - block.low).cast<double>() / block.side});
  return {0.5 * (bounds.low + bounds.high), 0.5 * (bounds.high - bounds.low), Vector3d::Zero()};
}

/// The sample in a far block: interpolated between the centres of the top cells and clamped to farBounds().
FieldSample farSample(const AdaptiveGrid& grid, const LocatedBlock& at, const Vector3d& p_F) {
  const AdaptiveShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.cell - Vector3d::Constant(0.5);
  const Vector3i low = cellAt(g, shape.size.array() - 1);  // of the cells between the centres
  const Vector3d u = withinCell(g - low.cast<double>());
  std::array<double, 8> corners;
  double error = 0.0;
  for (int k = 0; k < 8; ++k) {
    const Vector3i cell = (low + cubeCorner(k)).cwiseMin((shape.size.array() - 1).matrix());
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

DistanceBounds boundsWithin(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const LocatedBlock at = locate(grid, p_F);
  if (!at.block.leaf) return farBounds(grid, at);
  const double value = trilinear(grid.corners(at.block), at.u), error = grid.shape().error_bound;
  return {value - error, value + error};
}

FieldSample sampleWithin(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const LocatedBlock at = locate(grid, p_F);
  if (!at.block.leaf) return farSample(grid, at, p_F);
  const FieldValue inside = leafValue(grid, at);
  return {inside.value, grid.leafError(at.block), inside.gradient};
}

FieldValue interpolateWithin(const AdaptiveGrid& grid, const Vector3d& p_F) {
  const LocatedBlock at = locate(grid, p_F);
  if (at.block.leaf) return leafValue(grid, at);
  const FieldSample far = farSample(grid, at, p_F);
  return {far.value, far.gradient};
}

}  // namespace sdf_ccd
