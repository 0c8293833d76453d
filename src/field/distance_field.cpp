#include "sdf_ccd/field/distance_field.h"

#include <limits>
#include <stdexcept>

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

double gridLowerBound(const SparseGrid& grid, const Vector3d& p_F) {
  const GridShape& shape = grid.shape();
  const double to_surface_box = shape.surface_box.exteriorDistance(p_F);
  if (!shape.box().contains(p_F)) return to_surface_box;
  const LocatedCell cell = locate(grid, p_F);
  const double interpolated = trilinear(cell.corners, cell.u);
  const double rounding = std::abs(interpolated) * 4.0 * std::numeric_limits<float>::epsilon();
  double bound = interpolated - lipschitzError(cell.u, cell.side) - rounding;
  if (!cell.sampled && cell.corners[0] > 0.0) bound = std::max(bound, shape.band);
  // Inside the surface's box a point may be inside the body, so the distance to the box says nothing there.
  return to_surface_box > 0.0 ? std::max(bound, to_surface_box) : bound;
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
  // Outside the grid: no nearer than the surface's box, no farther than by way of the grid's boundary.
  const double low = gridLowerBound(grid, p_F);
  const double high = std::max(low, (p_F - q).norm() + value + error);
  const Vector3d nearest = p_F.cwiseMax(shape.surface_box.min()).cwiseMin(shape.surface_box.max());
  return {0.5 * (low + high), 0.5 * (high - low), (p_F - nearest).normalized()};
}

}  // namespace

DistanceField::DistanceField(const Primitive& primitive)
    : representation_(primitive), surface_box_(boundingBox(primitive)) {
  validate(primitive);
}

DistanceField::DistanceField(std::shared_ptr<const SparseGrid> grid) {
  if (!grid) throw std::invalid_argument("distance field: no grid");
  surface_box_ = grid->shape().surface_box;
  representation_ = std::move(grid);
}

const Primitive* DistanceField::primitive() const {
  return std::get_if<Primitive>(&representation_);
}

const SparseGrid* DistanceField::grid() const {
  const auto* grid = std::get_if<std::shared_ptr<const SparseGrid>>(&representation_);
  return grid ? grid->get() : nullptr;
}

FieldSample DistanceField::sample(const Vector3d& p_F) const {
  if (const Primitive* shape = primitive()) {
    const double value = signedDistance(*shape, p_F);
    return {value, 4.0 * std::numeric_limits<double>::epsilon() * (std::abs(value) + p_F.lpNorm<Eigen::Infinity>()),
            distanceGradient(*shape, p_F)};
  }
  return gridSample(*grid(), p_F);
}

double DistanceField::lowerBound(const Vector3d& p_F) const {
  if (const Primitive* shape = primitive()) return signedDistance(*shape, p_F);
  return gridLowerBound(*grid(), p_F);
}

double DistanceField::band() const {
  return primitive() ? std::numeric_limits<double>::infinity() : grid()->shape().band;
}

double DistanceField::errorBound() const {
  return primitive() ? 0.0 : grid()->errorBound();
}

std::size_t DistanceField::bytes() const {
  return primitive() ? sizeof(Primitive) : grid()->bytes();
}

}  // namespace sdf_ccd
