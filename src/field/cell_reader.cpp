#include "field/cell_reader.h"

#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "field/grid_cell.h"
#include "field/trilinear_cell.h"
#include "field/uniform/sparse_grid.h"

namespace sdf_ccd {

CellReader::CellReader(const DistanceField& field)
    : field_(field),
      primitive_(field.primitive()),
      grid_(FieldAccess::grid(field)),
      adaptive_(FieldAccess::adaptive(field)) {
  if (primitive_) return;
  box_ = field.box();
  origin_ = grid_ ? grid_->shape().origin : adaptive_->shape().origin;
  unit_ = grid_ ? grid_->shape().cell : adaptive_->shape().unit();
}

bool CellReader::enter(const Vector3d& p_F) {
  if (primitive_) return false;
  const Vector3d g = inLattice(p_F);
  if (!enterLattice(p_F, g)) return false;
  u_ = inCell(g);
  return true;
}

/// Moves to the cell (or leaf) that holds the point, and reads its corners unless it is the current one.
/// @param g  the point in cells (or units of the adaptive grid) from the origin.
/// @return false if the point is outside the grid or in a cell without corner values.
bool CellReader::enterLattice(const Vector3d& p_F, const Vector3d& g) {
  return holds(g) || (box_.contains(p_F) && (grid_ ? enterCell(g) : enterLeaf(g)));
}

bool CellReader::holds(const Vector3d& g) const {
  const Vector3d from_low = g - low_;
  return (from_low.array() >= 0.0).all() && (from_low.array() < side_).all();
}

Vector3d CellReader::inCell(const Vector3d& g) const {
  return withinCell((g - low_) * per_side_);
}

bool CellReader::enter(const Vector3d& from_F, const Vector3d& to_F, CellLine& line) {
  if (primitive_) return false;
  const Vector3d from = inLattice(from_F), to = inLattice(to_F);
  if (!enterLattice(from_F, from) || !holds(to)) return false;
  line = {inCell(from), inCell(to)};
  return true;
}

bool CellReader::enterMiddle(const Vector3d& from_F, const Vector3d& to_F, CellLine& line) {
  const Vector3d middle_F = 0.5 * (from_F + to_F);
  if (primitive_ || !enterLattice(middle_F, inLattice(middle_F))) return false;
  line = {inCell(inLattice(from_F)), inCell(inLattice(to_F))};
  return true;
}

bool CellReader::enterCell(const Vector3d& g) {
  const Vector3i cell = cellAt(g, grid_->shape().cells());
  const std::int32_t slot = grid_->slot(GridShape::brickOf(cell));
  if (slot == SparseGrid::kFar) return false;
  corners_ = grid_->cellCorners(slot, GridShape::inBrick(cell));
  low_ = cell.cast<double>();
  side_ = per_side_ = 1.0;
  return true;
}

bool CellReader::enterLeaf(const Vector3d& g) {
  const AdaptiveBlock block = adaptive_->block(cellAt(g, adaptive_->shape().units()));
  if (!block.leaf) return false;
  corners_ = adaptive_->corners(block);
  low_ = block.low.cast<double>();
  side_ = block.side;
  per_side_ = 1.0 / side_;  // exact: sides are powers of two
  return true;
}

FieldValue CellReader::interpolate(const Vector3d& p_F) {
  if (!enter(p_F)) return field_.interpolate(p_F);
  return {trilinear(corners_, u_), trilinearGradient(corners_, u_) / side()};
}

double CellReader::value(const Vector3d& p_F) {
  if (primitive_) return signedDistance(*primitive_, p_F);
  return enter(p_F) ? trilinear(corners_, u_) : field_.interpolate(p_F).value;
}

}  // namespace sdf_ccd
