#pragma once

#include <array>

#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// Two points in a cell, by their coordinates in it, in [0, 1]³.
struct CellLine {
  Vector3d from, to;
};

/// Interpolates a field at a sequence of points, most of which lie in the same cell as their predecessor: the corners
/// of a cell are read once. The results equal those of DistanceField::interpolate() bit by bit.
class CellReader {
 public:
  /// @param field  must outlive this.
  explicit CellReader(const DistanceField& field);

  FieldValue interpolate(const Vector3d& p_F);

  /// The value alone.
  double value(const Vector3d& p_F);

  /// Moves to the cell (or leaf) that holds both points. @return false if none with corner values does.
  bool enter(const Vector3d& from_F, const Vector3d& to_F, CellLine& line);

  /// Moves to the cell that holds the middle of two points, which lie in it or, by rounding, beside it.
  bool enterMiddle(const Vector3d& from_F, const Vector3d& to_F, CellLine& line);

  /// Of the current cell, once one of these has returned true.
  const std::array<double, 8>& corners() const { return corners_; }
  double side() const { return side_ * unit_; }  ///< [m]

 private:
  Vector3d inLattice(const Vector3d& p_F) const { return (p_F - origin_) / unit_; }
  Vector3d inCell(const Vector3d& g) const;
  bool enter(const Vector3d& p_F);
  bool enterLattice(const Vector3d& p_F, const Vector3d& g);
  bool holds(const Vector3d& g) const;
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
  double side_ = 0.0;      // 0: no cell has been read yet
  double per_side_ = 0.0;  // 1 / side
  std::array<double, 8> corners_;
  Vector3d u_ = Vector3d::Zero();  // the point's coordinates in the cell, [0, 1]³
};

}  // namespace sdf_ccd
