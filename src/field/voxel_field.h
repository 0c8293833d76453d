#pragma once

#include <bitset>
#include <cstddef>
#include <optional>

#include "mesh/voxel_solid.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// A cube of voxels, each occupied or free; all voxels outside it are free.
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

/// The field of a block's occupied voxels, with cells of half a voxel and exact distances at their corners, as
/// buildField() computes it from voxelSurface(); takes about a millisecond.
/// @param band  as in FieldOptions, but limited to 16 cells [m].
/// @return std::nullopt if no voxel is occupied.
std::optional<DistanceField> voxelField(const VoxelBlock& block, const VoxelLattice& lattice, double band);

/// The field of a map, as buildField() computes it from the mesh of the map's boundary, in a fraction of the time; only
/// the origin of the cells differs.
/// @param options  with a cell_size of which the voxels' side is a multiple, up to rounding, and a band of up to 32
/// cells: see
///                 canBeLattice().
/// @throws std::length_error as buildField(); Cancelled.
DistanceField buildField(const VoxelSolid& solid, const FieldOptions& options, const Progress& progress = {});

/// Whether the options meet these conditions.
bool canBeLattice(const VoxelSolid& solid, const FieldOptions& options);

}  // namespace sdf_ccd
