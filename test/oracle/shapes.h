#pragma once

#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "sdf_ccd/mesh.h"

/// Small closed meshes whose distances, areas and volumes are known.
namespace sdf_ccd::test {

constexpr double kPi = 3.14159265358979323846;

/// Twelve triangles; corners at ±half_size.
inline TriangleMesh boxMesh(const Vector3d& half_size) {
  TriangleMesh mesh;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d sign((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1);
    mesh.vertices.push_back(half_size.cwiseProduct(sign));
  }
  const std::array<std::array<int, 4>, 6> faces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& face : faces) {
    mesh.triangles.emplace_back(face[0], face[1], face[2]);
    mesh.triangles.emplace_back(face[0], face[2], face[3]);
  }
  return mesh;
}

/// Icosahedron whose 20 triangles are divided into four `subdivisions` times; all vertices on the sphere.
inline TriangleMesh icosphere(double radius, int subdivisions) {
  const double g = (1.0 + std::sqrt(5.0)) / 2.0;
  TriangleMesh mesh;
  mesh.vertices = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                   {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  for (Vector3d& v : mesh.vertices) v.normalize();
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<int>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return place->second;
    };
    std::vector<Vector3i> finer;
    for (const Vector3i& t : mesh.triangles) {
      const int a = middle(t[0], t[1]), b = middle(t[1], t[2]), c = middle(t[2], t[0]);
      finer.insert(finer.end(), {{t[0], a, c}, {a, t[1], b}, {c, b, t[2]}, {a, b, c}});
    }
    mesh.triangles = std::move(finer);
  }
  for (Vector3d& v : mesh.vertices) v *= radius;
  return mesh;
}

/// Torus about z: a tube of radius r around a circle of radius R; n steps around z, m around the tube.
inline TriangleMesh torusMesh(double R, double r, int n, int m) {
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < m; ++j) {
      const double u = 2 * kPi * i / n, v = 2 * kPi * j / m;
      const double rho = R + r * std::cos(v);
      mesh.vertices.emplace_back(rho * std::cos(u), rho * std::sin(u), r * std::sin(v));
      const int i1 = (i + 1) % n, j1 = (j + 1) % m;
      mesh.triangles.emplace_back(i * m + j, i1 * m + j, i1 * m + j1);
      mesh.triangles.emplace_back(i * m + j, i1 * m + j1, i * m + j1);
    }
  }
  return mesh;
}

/// The same mesh inside out.
inline TriangleMesh flipped(TriangleMesh mesh) {
  for (Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

inline TriangleMesh translated(TriangleMesh mesh, const Vector3d& offset) {
  for (Vector3d& v : mesh.vertices) v += offset;
  return mesh;
}

}  // namespace sdf_ccd::test
