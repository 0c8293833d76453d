#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Collects faces of voxels as triangles with shared vertices.
class VoxelSurface {
 public:
  static constexpr std::size_t kBytesPerFace = 256;  ///< upper bound of the peak: vectors double as they grow

  using Cell = std::array<std::int64_t, 3>;  ///< indices of a voxel, or of its lower corner

  /// @param resolution  voxel size [m].
  /// @param origin      index, along each axis, of the corner at the frame's origin.
  VoxelSurface(double resolution, std::int64_t origin) : resolution_(resolution), origin_(origin) {}

  /// Adds the face of `cell` normal to `axis`, on its upper or lower side, with its normal pointing out of the cell.
  void addFace(const Cell& cell, int axis, bool upper) {
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    Cell corner = cell;
    corner[axis] += upper;
    const int a = vertex(corner);
    ++corner[u];
    const int b = vertex(corner);
    ++corner[v];
    const int c = vertex(corner);
    --corner[u];
    const int d = vertex(corner);
    // a b c d is counter-clockwise about +axis.
    mesh_.triangles.push_back(upper ? Vector3i(a, b, c) : Vector3i(a, c, b));
    mesh_.triangles.push_back(upper ? Vector3i(a, c, d) : Vector3i(a, d, c));
  }

  TriangleMesh take() { return std::move(mesh_); }

 private:
  int vertex(const Cell& corner) {
    const std::uint64_t key = static_cast<std::uint64_t>(corner[0]) << 40 |
                              static_cast<std::uint64_t>(corner[1]) << 20 | static_cast<std::uint64_t>(corner[2]);
    const auto [found, is_new] = index_.emplace(key, static_cast<int>(mesh_.vertices.size()));
    if (is_new) {
      Vector3d p;
      for (int i = 0; i < 3; ++i) p[i] = static_cast<double>(corner[i] - origin_) * resolution_;
      mesh_.vertices.push_back(p);
    }
    return found->second;
  }

  double resolution_;
  std::int64_t origin_;
  TriangleMesh mesh_;
  std::unordered_map<std::uint64_t, int> index_;
};

}  // namespace sdf_ccd
