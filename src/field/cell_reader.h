#pragma once

#include <array>

#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd {

/// Interpolates a field at a sequence of points, most of which lie in the same cell as their predecessor: the corners
/// of a cell are read once. The results equal those of DistanceField::interpolate() bit by bit.
class CellReader {
 public:
  /// @param field  must outlive this.
  explicit CellReader(const DistanceField& field);

  FieldValue interpolate(const Vector3d& p_F);

  /// The value alone.
  double value(const Vector3d& p_F);

  /// Moves to the cell (or leaf) that holds the point, and reads its corners unless it is the current one.
  /// @return false if the point is in none with corner values, as those of a primitive are.
  bool enter(const Vector3d& p_F);

  /// The following are of the current cell, once enter() has returned true.
  const std::array<double, 8>& corners() const { return corners_; }
  double side() const { return side_ * unit_; }  ///< [m]

  /// Whether it holds the point.
  bool holds(const Vector3d& p_F) const { return holdsLattice(inLattice(p_F)); }

  /// The point's coordinates in it, clamped to [0, 1]³.
  Vector3d local(const Vector3d& p_F) const;

 private:
  Vector3d inLattice(const Vector3d& p_F) const { return (p_F - origin_) / unit_; }
  bool holdsLattice(const Vector3d& g) const;
  bool enterCell(const Vector3d& g);
  bool enterLeaf(const Vector3d& g);

  const DistanceField& field_;
  const Primitive* primitive_;
  const SparseGrid* grid_;
  const AdaptiveGrid* adaptive_;
  AlignedBox3d box_;  // of the grid
  Vector3d origin_ = Vector3d::Zero();
  double unit_ = 0.0;  // a cell, or a unit of the adaptive grid [m]
  // The current cell (or leaf): first corner and side, in cells (or units of the adaptive grid).
  Vector3d low_ = Vector3d::Zero();
  double side_ = 0.0;  // 0: no cell has been read yet
  std::array<double, 8> corners_;
  Vector3d u_ = Vector3d::Zero();  // the point's coordinates in the cell, [0, 1]³
};

}  // namespace sdf_ccd
