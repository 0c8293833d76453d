#include "field/grid_cell.h"
#include "field/grid_sample.h"
#include "field/trilinear_cell.h"

#include <limits>

#include "sample_bracket.h"

namespace sdf_ccd {
namespace {

/// The cell (or, far from the surface, the brick) that holds a point of the grid's box.
struct LocatedCell {
  std::array<double, 8> corners;
  Vector3d u;   ///< the point in it, [0, 1]³
  double side;  ///< [m]
  bool sampled;
};

LocatedCell locate(const SparseGrid& grid, const Vector3d& p_F) {
  const GridShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.cell;
  const Vector3i cell = cellAt(g, shape.cells());
  const Vector3i brick = GridShape::brickOf(cell);
  const std::int32_t slot = grid.slot(brick);
  if (slot != SparseGrid::kFar) {
    return {grid.cellCorners(slot, GridShape::inBrick(cell)), withinCell(g - cell.cast<double>()), shape.cell, true};
  }
  return {grid.brickCorners(brick), withinCell(g / GridShape::kBrick - brick.cast<double>()),
          GridShape::kBrick * shape.cell, false};
}

FieldValue interpolateIn(const LocatedCell& cell) {
  return {trilinear(cell.corners, cell.u), trilinearGradient(cell.corners, cell.u) / cell.side};
}

/// The interpolated value; in a brick without samples, where |φ| exceeds the band, at least the band.
double farValue(const SparseGrid& grid, const LocatedCell& cell, double interpolated) {
  if (cell.sampled) return interpolated;
  const double band = grid.shape().band;
  return cell.corners[0] > 0.0 ? std::max(interpolated, band) : std::min(interpolated, -band);
}

/// Error bound of the distance interpolated in a cell or brick [m].
double errorAt(const SparseGrid& grid, const LocatedCell& cell, double interpolated) {
  return lipschitzError(cell.u, cell.side) + (cell.sampled ? grid.rounding() : 0.0) +
         4.0 * std::numeric_limits<float>::epsilon() * std::abs(interpolated);
}

}  // namespace

DistanceBounds boundsWithin(const SparseGrid& grid, const Vector3d& p_F) {
  const double band = grid.shape().band;
  const LocatedCell cell = locate(grid, p_F);
  const double interpolated = trilinear(cell.corners, cell.u), error = errorAt(grid, cell, interpolated);
  DistanceBounds bounds{interpolated - error, interpolated + error};
  if (!cell.sampled && cell.corners[0] > 0.0) bounds.low = std::max(bounds.low, band);
  if (!cell.sampled && cell.corners[0] < 0.0) bounds.high = std::min(bounds.high, -band);
  return bounds;
}

FieldSample sampleWithin(const SparseGrid& grid, const Vector3d& p_F) {
  const LocatedCell cell = locate(grid, p_F);
  const FieldValue at = interpolateIn(cell);
  const double error = errorAt(grid, cell, at.value);
  if (!cell.sampled) return {farValue(grid, cell, at.value), error, at.gradient};
  const DistanceBounds bracket = sampleBracket(grid, p_F, at.gradient);
  return {at.value, std::min(error, std::max(bracket.high - at.value, at.value - bracket.low)), at.gradient};
}

FieldValue interpolateWithin(const SparseGrid& grid, const Vector3d& p_F) {
  const LocatedCell cell = locate(grid, p_F);
  const FieldValue at = interpolateIn(cell);
  return {farValue(grid, cell, at.value), at.gradient};
}

}  // namespace sdf_ccd
