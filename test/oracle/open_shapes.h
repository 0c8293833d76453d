#pragma once

#include <algorithm>
#include <limits>

#include "mesh/triangle.h"
#include "oracle/shapes.h"

/// Meshes that are not closed.
namespace sdf_ccd::test {

/// A mesh without the triangles whose centroids the predicate selects.
template <typename Lost>
TriangleMesh without(TriangleMesh mesh, Lost lost) {
  const auto is_lost = [&](const Vector3i& t) {
    return lost((mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0);
  };
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), is_lost), mesh.triangles.end());
  return mesh;
}

/// A box of this half side without its lid at the top (z).
inline TriangleMesh binMesh(double half) {
  return without(boxMesh(Vector3d::Constant(half)), [half](const Vector3d& p) { return p.z() > 0.99 * half; });
}

/// Distance from a point to the nearest triangle [m], by brute force.
inline double distance(const TriangleMesh& mesh, const Vector3d& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d q = closestOnTriangle(cornersOf(mesh.vertices, t), p);
    least = std::min(least, (q - p).norm());
  }
  return least;
}

}  // namespace sdf_ccd::test
