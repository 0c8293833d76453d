#include "grid_sample.h"

#include <limits>

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
  const Vector3i last = shape.cells().array() - 1;
  const Vector3i cell = g.array().floor().max(0.0).matrix().cast<int>().cwiseMin(last);
  const Vector3i brick = cell / GridShape::kBrick;
  const std::int32_t slot = grid.slot(brick);
  const auto unit = [](const Vector3d& u) { return Vector3d(u.array().max(0.0).min(1.0)); };
  if (slot != SparseGrid::kFar) {
    return {grid.cellCorners(slot, cell - GridShape::kBrick * brick), unit(g - cell.cast<double>()), shape.cell, true};
  }
  return {grid.brickCorners(brick), unit(g / GridShape::kBrick - brick.cast<double>()), GridShape::kBrick * shape.cell,
          false};
}

/// Where the brick has no samples |φ| exceeds the band, whatever the coarse interpolation says.
double farValue(const SparseGrid& grid, const LocatedCell& cell, double interpolated) {
  const double band = grid.shape().band;
  return cell.corners[0] > 0.0 ? std::max(interpolated, band) : std::min(interpolated, -band);
}

}  // namespace

DistanceBounds gridBounds(const SparseGrid& grid, const Vector3d& p_F) {
  const GridShape& shape = grid.shape();
  const double to_surface_box = shape.surface_box.exteriorDistance(p_F);
  if (!shape.box().contains(p_F)) return {to_surface_box, std::numeric_limits<double>::infinity()};
  const LocatedCell cell = locate(grid, p_F);
  const double interpolated = trilinear(cell.corners, cell.u);
  const double rounding = std::abs(interpolated) * 4.0 * std::numeric_limits<float>::epsilon();
  const double error = lipschitzError(cell.u, cell.side) + rounding;
  DistanceBounds bounds{interpolated - error, interpolated + error};
  if (!cell.sampled && cell.corners[0] > 0.0) bounds.low = std::max(bounds.low, shape.band);
  if (!cell.sampled && cell.corners[0] < 0.0) bounds.high = std::min(bounds.high, -shape.band);
  // Inside the surface's box a point may be inside the body, so the distance to the box says nothing there.
  if (to_surface_box > 0.0) bounds.low = std::max(bounds.low, to_surface_box);
  return bounds;
}

FieldSample gridSample(const SparseGrid& grid, const Vector3d& p_F) {
  const GridShape& shape = grid.shape();
  const AlignedBox3d box = shape.box();
  const Vector3d q = p_F.cwiseMax(box.min()).cwiseMin(box.max());
  const LocatedCell cell = locate(grid, q);
  const double interpolated = trilinear(cell.corners, cell.u);
  const double value = cell.sampled ? interpolated : farValue(grid, cell, interpolated);
  const double error =
      lipschitzError(cell.u, cell.side) + 4.0 * std::numeric_limits<float>::epsilon() * std::abs(interpolated);
  if (q == p_F) return {value, error, trilinearGradient(cell.corners, cell.u) / cell.side};
  return outsideSample(shape.surface_box, p_F, q, {value, error, Vector3d::Zero()});
}

}  // namespace sdf_ccd
