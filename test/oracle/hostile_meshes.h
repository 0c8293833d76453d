#pragma once

#include <cmath>
#include <random>

#include "oracle/shapes.h"

namespace sdf_ccd::test {

/// Valid meshes, each triangle with vertices of its own, with which the time of some algorithm grows with the square of
/// the number of triangles.
///@{
inline void addTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, TriangleMesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// Triangles about one common edge.
inline TriangleMesh starMesh(int triangles) {
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const double angle = 6.283 * i / triangles;
    addTriangle({0, 0, 0}, {0, 0, 1}, {std::cos(angle), std::sin(angle), 0.5}, mesh);
  }
  return mesh;
}

/// A flat fan of triangles of length 1 that are `width` / triangles wide.
inline TriangleMesh needlesMesh(int triangles, double width) {
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i)
    addTriangle({0, 0, 0}, {1, width * i / triangles, 0}, {1, width * (i + 1) / triangles, 0}, mesh);
  return mesh;
}

/// Triangles with random corners in a cube of side 2, most of which cross many others.
inline TriangleMesh randomTrianglesMesh(int triangles) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
  const auto point = [&] {
    const double x = coordinate(random), y = coordinate(random);
    return Vector3d(x, y, coordinate(random));
  };
  TriangleMesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const Vector3d a = point(), b = point();
    addTriangle(a, b, point(), mesh);
  }
  return mesh;
}

/// Octahedra within each other, the largest of radius 1.
inline TriangleMesh nestedMesh(int shells) {
  TriangleMesh mesh;
  for (int i = 1; i <= shells; ++i) {
    const double r = double(i) / shells;
    for (int octant = 0; octant < 8; ++octant) {
      const Vector3d x((octant & 1) ? -r : r, 0, 0), y(0, (octant & 2) ? -r : r, 0), z(0, 0, (octant & 4) ? -r : r);
      const bool flips = ((octant & 1) + ((octant >> 1) & 1) + (octant >> 2)) % 2 == 1;
      addTriangle(x, flips ? z : y, flips ? y : z, mesh);
    }
  }
  return mesh;
}
///@}

}  // namespace sdf_ccd::test
