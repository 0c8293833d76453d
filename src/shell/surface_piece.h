#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// A triangular piece of a surface that is halved until a decision about it is possible.
struct SurfacePiece {
  std::array<Vector3d, 3> corners;

  static SurfacePiece of(const TriangleMesh& mesh, int triangle) {
    const Vector3i& t = mesh.triangles[triangle];
    return {{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}};
  }

  Vector3d centroid() const { return (corners[0] + corners[1] + corners[2]) / 3; }

  double area() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm() / 2; }

  /// Index of the corner opposite the longest edge, and that edge's squared length.
  std::pair<int, double> longestEdge() const {
    std::pair<int, double> longest{0, -1.0};
    for (int i = 0; i < 3; ++i) {
      const double length2 = (corners[(i + 2) % 3] - corners[(i + 1) % 3]).squaredNorm();
      if (length2 > longest.second) longest = {i, length2};
    }
    return longest;
  }

  /// Both halves, cut from the longest edge's middle to the opposite corner.
  std::pair<SurfacePiece, SurfacePiece> halves() const {
    const int corner = longestEdge().first, next = (corner + 1) % 3, last = (corner + 2) % 3;
    std::pair<SurfacePiece, SurfacePiece> result{*this, *this};
    result.first.corners[last] = result.second.corners[next] = (corners[next] + corners[last]) / 2;
    return result;
  }

  /// Largest distance of the piece from q, squared: distance is convex, so a corner has it.
  double farthest2(const Vector3d& q) const {
    return std::max({(corners[0] - q).squaredNorm(), (corners[1] - q).squaredNorm(), (corners[2] - q).squaredNorm()});
  }
};

}  // namespace sdf_ccd
