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
  if (!primitive_) box_ = field.box();
}

/// Moves to the cell (or leaf) that holds the point, and reads its corners if it is not the previous one.
/// @return false if the point is outside the grid or in a cell without corner values.
bool CellReader::enter(const Vector3d& p_F) {
  return box_.contains(p_F) && (grid_ ? enterCell(p_F) : enterLeaf(p_F));
}

bool CellReader::enterCell(const Vector3d& p_F) {
  const GridShape& shape = grid_->shape();
  const Vector3d g = (p_F - shape.origin) / shape.cell;
  const Vector3i cell = cubeOf(g, shape.cells());
  if (side_ == 0 || cell != low_) {
    const Vector3i brick = cell / GridShape::kBrick;
    const std::int32_t slot = grid_->slot(brick);
    if (slot == SparseGrid::kFar) return false;
    corners_ = grid_->cellCorners(slot, cell - GridShape::kBrick * brick);
    low_ = cell;
    side_ = 1;
  }
  u_ = unit(g - cell.cast<double>());
  return true;
}

bool CellReader::enterLeaf(const Vector3d& p_F) {
  const AdaptiveShape& shape = adaptive_->shape();
  const Vector3d g = (p_F - shape.origin) / shape.unit();
  const Vector3i cube = cubeOf(g, shape.units());
  if (side_ == 0 || (cube.array() < low_.array()).any() || (cube.array() >= low_.array() + side_).any()) {
    const AdaptiveBlock block = adaptive_->block(cube);
    if (!block.leaf) return false;
    corners_ = adaptive_->corners(block);
    low_ = block.low;
    side_ = block.side;
  }
  u_ = unit((g - low_.cast<double>()) / side_);
  return true;
}

FieldValue CellReader::interpolate(const Vector3d& p_F) {
  if (primitive_ || !enter(p_F)) return field_.interpolate(p_F);
  const double side = grid_ ? grid_->shape().cell : side_ * adaptive_->shape().unit();
  return {trilinear(corners_, u_), trilinearGradient(corners_, u_) / side};
}

double CellReader::value(const Vector3d& p_F) {
  if (primitive_) return signedDistance(*primitive_, p_F);
  return enter(p_F) ? trilinear(corners_, u_) : field_.interpolate(p_F).value;
}

}  // namespace sdf_ccd
