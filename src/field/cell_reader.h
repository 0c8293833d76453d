#pragma once

#include <array>

#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {

/// Interpolates a field at a sequence of points, most of which are in the same cell as the one before: that cell's
/// corners are read once. The results equal those of DistanceField::interpolate() bit by bit.
class CellReader {
 public:
  /// @param field  must outlive this.
  explicit CellReader(const DistanceField& field);

  FieldValue interpolate(const Vector3d& p_F);

  /// The value alone.
  double value(const Vector3d& p_F);

 private:
  bool enter(const Vector3d& p_F);
  bool enterCell(const Vector3d& p_F);
  bool enterLeaf(const Vector3d& p_F);

  const DistanceField& field_;
  const Primitive* primitive_;
  const SparseGrid* grid_;
  const AdaptiveGrid* adaptive_;
  AlignedBox3d box_;  // of the grid
  // The cell, or leaf; in cells, or units of the adaptive grid.
  Vector3i low_ = Vector3i::Zero();
  int side_ = 0;  // 0: none is known
  std::array<double, 8> corners_;
  Vector3d u_ = Vector3d::Zero();  // the point in it, [0, 1]³
};

}  // namespace sdf_ccd
