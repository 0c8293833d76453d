#pragma once

#include <algorithm>
#include <vector>

#include "mesh/corners.h"
#include "oracle/triangle_distance.h"
#include "surface/box_tree.h"

/// Surfaces of rounded triangles, and their distances by brute force.
namespace sdf_ccd::test {

inline std::vector<RoundedTriangle> roundedTriangles(const TriangleMesh& mesh, double radius = 0.0) {
  std::vector<RoundedTriangle> all;
  for (int i = 0; i < int(mesh.triangles.size()); ++i) all.push_back({cornersOf(mesh, i), radius});
  return all;
}

inline BoxTree treeOf(const TriangleMesh& mesh, double radius = 0.0) {
  return BoxTree(roundedTriangles(mesh, radius));
}

/// Distance of two rounded triangles [m]; negative if they overlap.
inline Real distance(const RoundedTriangle& a, const RoundedTriangle& b,
                     const Isometry3d& X_AB = Isometry3d::Identity()) {
  return triangleDistance(exact(a.corners), exact(b.corners, X_AB)) - a.radius - b.radius;
}

}  // namespace sdf_ccd::test
