#include "field/cell_reader.h"

#include "field/adaptive/adaptive_grid.h"
#include "field/uniform/sparse_grid.h"

namespace sdf_ccd {
namespace {

Vector3d unit(const Vector3d& u) {
  return u.array().max(0.0).min(1.0);
}

/// The cube of a lattice that holds a point, clamped to the `count` cubes per axis.
Vector3i cubeOf(const Vector3d& g, const Vector3i& count) {
  return g.array().floor().max(0.0).matrix().cast<int>().cwiseMin((count.array() - 1).matrix());
}

}  // namespace

CellReader::CellReader(const DistanceField& field)
    : field_(field), primitive_(field.primitive()), grid_(field.grid()), adaptive_(field.adaptive()) {
  if (primitive_) return;
  box_ = field.box();
  origin_ = grid_ ? grid_->shape().origin : adaptive_->shape().origin;
  unit_ = grid_ ? grid_->shape().cell : adaptive_->shape().unit();
}

/// Moves to the cell (or leaf) that holds the point, and reads its corners if it is not the previous one.
/// @return false if the point is outside the grid or in a cell without corner values.
bool CellReader::enter(const Vector3d& p_F) {
  const Vector3d g = (p_F - origin_) / unit_;
  return stays(g) || (box_.contains(p_F) && (grid_ ? enterCell(g) : enterLeaf(g)));
}

/// Whether the point is in the previous cell.
bool CellReader::stays(const Vector3d& g) {
  const Vector3d from_low = g - low_;
  if (!((from_low.array() >= 0.0).all() && (from_low.array() < side_).all())) return false;
  u_ = grid_ ? from_low : Vector3d(from_low / side_);
  return true;
}

bool CellReader::enterCell(const Vector3d& g) {
  const Vector3i cell = cubeOf(g, grid_->shape().cells());
  const Vector3i brick = cell / GridShape::kBrick;
  const std::int32_t slot = grid_->slot(brick);
  if (slot == SparseGrid::kFar) return false;
  corners_ = grid_->cellCorners(slot, cell - GridShape::kBrick * brick);
  low_ = cell.cast<double>();
  side_ = 1.0;
  u_ = unit(g - low_);
  return true;
}

bool CellReader::enterLeaf(const Vector3d& g) {
  const AdaptiveBlock block = adaptive_->block(cubeOf(g, adaptive_->shape().units()));
  if (!block.leaf) return false;
  corners_ = adaptive_->corners(block);
  low_ = block.low.cast<double>();
  side_ = block.side;
  u_ = unit((g - low_) / side_);
  return true;
}

FieldValue CellReader::interpolate(const Vector3d& p_F) {
  if (primitive_ || !enter(p_F)) return field_.interpolate(p_F);
  return {trilinear(corners_, u_), trilinearGradient(corners_, u_) / (side_ * unit_)};
}

double CellReader::value(const Vector3d& p_F) {
  if (primitive_) return signedDistance(*primitive_, p_F);
  return enter(p_F) ? trilinear(corners_, u_) : field_.interpolate(p_F).value;
}

}  // namespace sdf_ccd
