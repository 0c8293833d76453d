#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// The corners of a triangle, which may be degenerate.
using Corners = std::array<Vector3d, 3>;

/// The same, where they are stored.
using CornerPointers = std::array<const Vector3d*, 3>;

inline CornerPointers pointersTo(const Corners& c) {
  return {&c[0], &c[1], &c[2]};
}

inline Corners copyOf(const CornerPointers& c) {
  return {*c[0], *c[1], *c[2]};
}

inline Corners cornersOf(const std::vector<Vector3d>& vertices, const Vector3i& triangle) {
  return {vertices[triangle[0]], vertices[triangle[1]], vertices[triangle[2]]};
}

inline Corners cornersOf(const TriangleMesh& mesh, int triangle) {
  return cornersOf(mesh.vertices, mesh.triangles[triangle]);
}

inline double longestEdge(const Corners& c) {
  return std::max({(c[1] - c[0]).norm(), (c[2] - c[1]).norm(), (c[0] - c[2]).norm()});
}

/// Twice the triangle's area long, to where its corners run counter-clockwise [m²].
inline Vector3d areaNormal(const Corners& c) {
  return (c[1] - c[0]).cross(c[2] - c[0]);
}

inline Vector3d centroid(const Corners& c) {
  return (c[0] + c[1] + c[2]) / 3.0;
}

/// Distance of the farthest corner from p: no point of the triangle is farther.
inline double farthestDistance(const Corners& c, const Vector3d& p) {
  return std::max({(c[0] - p).norm(), (c[1] - p).norm(), (c[2] - p).norm()});
}

}  // namespace sdf_ccd
