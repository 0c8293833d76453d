#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Whole voxels, reconstructed from the mesh that is their boundary.
class VoxelSolid {
 public:
  /// @return null if the mesh is not the boundary of equal cubes on one lattice, or their box has more than
  /// `max_voxels`.
  static std::shared_ptr<const VoxelSolid> of(const TriangleMesh& mesh,
                                              std::uint64_t max_voxels = std::uint64_t{1} << 33);

  double size() const { return size_; }               ///< of a voxel [m]
  const Vector3d& origin() const { return origin_; }  ///< lowest corner of the voxel 0 0 0 [m]
  const Vector3i& count() const { return count_; }    ///< of voxels, in the box that holds all occupied ones
  double moved() const { return moved_; }             ///< distance of the mesh's vertices from the lattice, at most [m]
  AlignedBox3d box() const { return {origin_, origin_ + size_ * count_.cast<double>()}; }

  /// Whether a voxel is occupied; those outside the box are free.
  bool isIn(int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= count_.x() || y >= count_.y() || z >= count_.z()) return false;
    return (row(y, z)[x / 64] >> (x % 64) & 1) != 0;
  }

  std::size_t bytes() const { return bits_.size() * sizeof(bits_[0]); }

  /// Whether an occupied voxel is within `slack` [m] of a point along each axis; the point in the mesh's frame.
  bool touches(const Vector3d& p, double slack) const;

  /// Whether all voxels within `slack` [m] of a point along each axis are occupied; the point in the mesh's frame.
  bool contains(const Vector3d& p, double slack) const;

  /// Occupied voxels [begin, end) along a row. runs() lists them in order; none for rows outside the box.
  struct Run {
    int begin, end;
  };
  void runs(int y, int z, std::vector<Run>& found) const;

 private:
  VoxelSolid() = default;
  const std::uint64_t* row(int y, int z) const {
    return bits_.data() +
           words_ * (static_cast<std::size_t>(z) * static_cast<std::size_t>(count_.y()) + static_cast<std::size_t>(y));
  }
  std::uint64_t* row(int y, int z) { return const_cast<std::uint64_t*>(std::as_const(*this).row(y, z)); }
  double faces() const;
  template <typename Test>  // gets the indices of a voxel; ends if it returns true
  bool anyVoxelAround(const Vector3d& p, double slack, const Test& test) const;

  double size_ = 0.0;
  double moved_ = 0.0;
  Vector3d origin_ = Vector3d::Zero();
  Vector3i count_ = Vector3i::Zero();
  std::size_t words_ = 0;            // of a row along x
  std::vector<std::uint64_t> bits_;  // row by row: y, then z
};

}  // namespace sdf_ccd
