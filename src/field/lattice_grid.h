#pragma once

#include <cstdint>
#include <vector>

#include "field/lattice_distance.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// A uniform grid around voxels. The corners of its cells and those of the voxels lie on one lattice.
struct LatticeGrid {
  /// @param origin   a corner of a voxel [m].
  /// @param options  with a cell_size of which the voxels' side is a multiple.
  LatticeGrid(const AlignedBox3d& box, const Vector3d& origin, const FieldOptions& options);

  GridShape shape;  ///< the step suits the largest sample that BrickSamples may take
  Vector3i low;     ///< the grid's first corner, in cells from the origin
};

/// Upper bound of |φ| at the samples that BrickSamples holds [cells].
int farthestSample(const GridShape& shape);

/// Samples of bricks, one after the other.
struct BrickSamples {
  /// Appends a brick's samples if |φ| ≤ band + cell may hold at one of its points; returns whether it did.
  /// @param distances  exact up to farthestSample().
  /// @param first      the brick's first corner, as a point of `distances`.
  bool append(const LatticeDistance& distances, const Vector3i& first, const GridShape& shape);

  std::int32_t bricks = 0;
  std::vector<std::int16_t> samples;
};

}  // namespace sdf_ccd
