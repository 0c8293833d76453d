#pragma once

#include <cstdint>
#include <vector>

#include "field/lattice_distance.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {

/// A uniform grid about voxels whose cells' corners lie on a lattice with the voxels' corners.
struct LatticeGrid {
  /// @param origin   a corner of a voxel [m].
  /// @param options  with a cell_size of which a voxel is a whole number.
  LatticeGrid(const AlignedBox3d& box, const Vector3d& origin, const FieldOptions& options);

  GridShape shape;  ///< its step is that of the farthest sample that BrickSamples may take
  Vector3i low;     ///< the grid's first corner, in cells from the origin
};

/// Upper bound of the distance from a surface of samples that BrickSamples takes [cells].
int farthestSample(const GridShape& shape);

/// Samples of bricks, one after the other.
struct BrickSamples {
  /// Takes a brick's samples if one of its points may be within the band, and a cell, of a surface.
  /// @param first  of the brick's corners, in the lattice of the distances. They must reach up to farthestSample().
  bool take(const LatticeDistance& distances, const Vector3i& first, const GridShape& shape);

  std::int32_t bricks = 0;
  std::vector<std::int16_t> samples;
};

}  // namespace sdf_ccd
