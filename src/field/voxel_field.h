#pragma once

#include <bitset>
#include <cstddef>
#include <optional>

#include "field/field_cost.h"
#include "geometry/voxel_solid.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// A cube of voxels, each occupied or not; the outside is not.
struct VoxelBlock {
  static constexpr int kSide = 20;  ///< voxels
  static constexpr std::size_t kCount = std::size_t{kSide} * kSide * kSide;

  std::bitset<kCount> occupied;  ///< x fastest, then y, then z

  static std::size_t index(int x, int y, int z) {
    return (static_cast<std::size_t>(z) * kSide + static_cast<std::size_t>(y)) * kSide + static_cast<std::size_t>(x);
  }
};

/// Position and size of a block's voxels.
struct VoxelLattice {
  Vector3d origin = Vector3d::Zero();  ///< lowest corner of the first voxel [m], frame F
  double size = 0.0;                   ///< of a voxel [m]
};

/// Boundary of a block's occupied voxels, two triangles a face, with shared vertices; see loadOctomapSurface().
TriangleMesh voxelSurface(const VoxelBlock& block, const VoxelLattice& lattice);

/// The field of a block's occupied voxels, with cells of half a voxel and exact distances at their corners: as
/// buildField() makes it of voxelSurface(), in about a millisecond.
/// @param band  as in FieldOptions [m].
/// @return none if nothing is occupied.
std::optional<DistanceField> voxelField(const VoxelBlock& block, const VoxelLattice& lattice, double band);

/// The field of a map, as buildField() makes it of the mesh that is its boundary, except for its cells' origin, in a
/// fraction of the time.
/// @param options  with a cell_size of which a voxel is a whole number, and a band of up to 32 cells (canBeLattice()).
/// @throws std::length_error as buildField(); Cancelled.
DistanceField buildField(const VoxelSolid& solid, const FieldOptions& options, const Progress& progress = {});

bool canBeLattice(const VoxelSolid& solid, const FieldOptions& options);

/// The expected cost of that: measured on a share of it.
FieldCost expectedCost(const VoxelSolid& solid, const FieldOptions& options);

}  // namespace sdf_ccd
