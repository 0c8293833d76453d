#pragma once

#include <array>
#include <vector>

#include "field/lattice_grid.h"
#include "mesh/voxel_solid.h"

namespace sdf_ccd {

/// Squared distances from the corners of a grid's bricks to the nearest occupied, or the nearest free, voxel [cells²]:
/// one axis after the other, as in LatticeDistance. Along y each corner visits the nearest rows first.
class CornerSquares {
 public:
  /// @param cells_per_voxel  along a voxel's side.
  CornerSquares(const VoxelSolid& solid, const LatticeGrid& grid, int cells_per_voxel, bool to_occupied)
      : solid_(solid),
        low_(grid.low),
        corners_(grid.shape.bricks.array() + 1),
        n_(cells_per_voxel),
        to_occupied_(to_occupied) {}

  /// Corners along x are processed in columns of this width.
  static constexpr int kWidth = 32;
  int columns() const { return (corners_.x() + kWidth - 1) / kWidth; }

  /// @param squares  of all corners; those of the column are reduced to the distances found, where these are smaller.
  void compute(int column, std::vector<float>& squares) const;

 private:
  struct Row {
    int y;
    std::array<float, kWidth> squares;
  };

  /// Squared distance from a corner to a voxel along an axis [cells²].
  float squaredGap(int voxel, int corner) const;
  void alongX(const std::vector<VoxelSolid::Run>& runs, int from, int width, std::array<float, kWidth>& squares) const;
  void alongY(const std::vector<Row>& rows, int y, int width, float* best) const;

  const VoxelSolid& solid_;
  const Vector3i low_, corners_;
  const int n_;
  const bool to_occupied_;
};

}  // namespace sdf_ccd
