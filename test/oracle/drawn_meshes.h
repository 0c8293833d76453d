#pragma once

#include "mesh/generated_mesh.h"
#include "oracle/shapes.h"

/// Meshes as people draw them: sheets, walls from both sides, open parts, parts inside out.
namespace sdf_ccd::test {

inline void addQuad(TriangleMesh& mesh, const std::array<Vector3d, 4>& corners) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.emplace_back(first, first + 1, first + 2);
  mesh.triangles.emplace_back(first, first + 2, first + 3);
}

/// An open band about z, |z| ≤ height / 2, with a disc at z = 0, its web, drawn from both sides on the band's middle.
inline TriangleMesh wheelMesh(double radius, double height, int steps) {
  TriangleMesh mesh;
  for (const double z : {-0.5 * height, 0.0, 0.5 * height}) {
    for (int i = 0; i < steps; ++i) {
      const double angle = 2 * kPi * i / steps;
      mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
    }
  }
  mesh.vertices.emplace_back(0, 0, 0);
  for (int i = 0; i < steps; ++i) {
    const int j = (i + 1) % steps;
    for (const int ring : {0, steps}) {
      mesh.triangles.emplace_back(ring + i, ring + j, ring + steps + j);
      mesh.triangles.emplace_back(ring + i, ring + steps + j, ring + steps + i);
    }
    mesh.triangles.emplace_back(3 * steps, steps + i, steps + j);
    mesh.triangles.emplace_back(3 * steps, steps + j, steps + i);
  }
  return mesh;
}

/// The sides of a box except the one at +y, each with vertices of its own, facing outward.
inline TriangleMesh openBox(const Vector3d& low, const Vector3d& high) {
  TriangleMesh mesh;
  const auto at = [&](int x, int y, int z) {
    return Vector3d(x ? high.x() : low.x(), y ? high.y() : low.y(), z ? high.z() : low.z());
  };
  addQuad(mesh, {at(0, 0, 0), at(0, 0, 1), at(0, 1, 1), at(0, 1, 0)});
  addQuad(mesh, {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)});
  addQuad(mesh, {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)});
  addQuad(mesh, {at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)});
  addQuad(mesh, {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)});
  return mesh;
}

/// A closed shelf of 1 × 1.08 × 0.061 m about the origin, not connected to the cupboard around it, open at +y. The
/// cupboard's outer and inner walls, the strips between them and a sheet below are separate parts. 46 triangles.
struct Cupboard {
  TriangleMesh shelf, walls;

  Cupboard() {
    shelf = boxMesh({0.5, 0.54, 0.0305});
    walls = openBox({-0.56, -0.62, -1.03}, {0.56, 0.58, 1.03});
    walls = merged(walls, flipped(openBox({-0.52, -0.58, -0.99}, {0.52, 0.58, 0.99})));
    for (const double side : {-1.0, 1.0}) {
      const double x0 = side < 0 ? -0.56 : 0.52, x1 = x0 + 0.04, y = 0.58;
      addQuad(walls, {Vector3d(x0, y, -1.03), {x0, y, 1.03}, {x1, y, 1.03}, {x1, y, -1.03}});
      const double z0 = side < 0 ? -1.03 : 0.99, z1 = z0 + 0.04;
      addQuad(walls, {Vector3d(-0.52, y, z0), {-0.52, y, z1}, {0.52, y, z1}, {0.52, y, z0}});
      addQuad(walls, {Vector3d(0.5 * side - 0.02, -0.5, -1.1),
                      {0.5 * side + 0.02, -0.5, -1.1},
                      {0.5 * side + 0.02, 0.5, -1.1},
                      {0.5 * side - 0.02, 0.5, -1.1}});
    }
    addQuad(walls, {Vector3d(-0.5, -0.5, -1.05), {-0.5, 0.5, -1.05}, {0.5, 0.5, -1.05}, {0.5, -0.5, -1.05}});
  }
};

/// One closed component that crosses itself, a body of revolution about z: a rod of radius 0.1 m below z = -0.05 and
/// 0.05 m above, |z| <= 0.2, with winding number 1, and a ring of radii 0.1 to 0.15 m, |z| <= 0.05, with -1.
inline TriangleMesh bowTieMesh() {
  constexpr int kSteps = 96;
  const std::vector<std::pair<double, double>> profile = {{0, -0.2},     {0.1, -0.2},   {0.1, 0.05}, {0.15, 0.05},
                                                          {0.15, -0.05}, {0.05, -0.05}, {0.05, 0.2}, {0, 0.2}};
  std::vector<std::vector<Vector3d>> rings;
  for (const auto& [r, z] : profile) {
    std::vector<Vector3d>& ring = rings.emplace_back();
    for (int i = 0; i < (r > 0 ? kSteps : 1); ++i) {
      const double angle = 2 * kPi * i / kSteps;
      ring.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    }
  }
  return lofted(rings);
}

/// A prism over a curve that crosses itself at the origin: a large part, a lobe inside out at 0 < x < 0.5, and over it,
/// at 0.2 < x < 0.4, an arm of the large part, so that the winding number is zero in both; 0 < z < 1.
inline TriangleMesh armOverItsLobe() {
  const std::vector<Eigen::Vector2d> curve = {{-2, -2},  {0.5, 0.5}, {0.5, -0.5}, {-2, 2}, {-1.5, 2.5}, {0.2, 2.5},
                                              {0.2, -3}, {0.4, -3},  {0.4, 3},    {-2, 3}, {-3, 3},     {-3, -2}};
  TriangleMesh mesh;
  for (const double z : {0.0, 1.0})
    for (const Eigen::Vector2d& p : curve) mesh.vertices.emplace_back(p.x(), p.y(), z);
  const int count = static_cast<int>(curve.size());
  for (int i = 0; i < count; ++i) {
    const int j = (i + 1) % count;
    mesh.triangles.emplace_back(i, j, count + j);
    mesh.triangles.emplace_back(i, count + j, count + i);
  }
  for (int i = 1; i + 1 < count; ++i) {  // fans: outside of the curve their triangles cancel
    mesh.triangles.emplace_back(0, i + 1, i);
    mesh.triangles.emplace_back(count, count + i, count + i + 1);
  }
  return mesh;
}

/// Two tetrahedra with the edge from (0, 0, -h) to (0, 0, h) in common, h = 0.15 m, the one at x < 0 with winding
/// number 1, the other with -1: one closed component, a double cone over a quadrilateral that crosses itself.
struct CrossedTetrahedra {
  TriangleMesh large, small;  ///< each as a mesh of its own, facing outward
  TriangleMesh mesh;

  CrossedTetrahedra() {
    mesh.vertices = {{-0.3, -0.2, 0}, {0.24, 0.16, 0}, {0.24, -0.16, 0}, {-0.3, 0.2, 0}, {0, 0, 0.15}, {0, 0, -0.15}};
    for (int i = 0; i < 4; ++i) {
      const int j = (i + 1) % 4;
      mesh.triangles.emplace_back(j, i, 4);
      mesh.triangles.emplace_back(i, j, 5);
    }
    const auto tetrahedron = [&](int a, int b) {
      return TriangleMesh{{mesh.vertices[a], mesh.vertices[b], mesh.vertices[4], mesh.vertices[5]},
                          {{0, 1, 2}, {1, 0, 3}, {0, 2, 3}, {1, 3, 2}}};
    };
    large = tetrahedron(3, 0);
    small = tetrahedron(2, 1);
    for (TriangleMesh* part : {&large, &small, &mesh}) {
      if (signedVolume(*part) < 0.0) *part = flipped(*part);
    }
  }
};

/// A box each of whose faces is divided in another way, so that adjacent faces share no edges.
inline TriangleMesh boxOfDividedFaces(const Vector3d& half_size) {
  TriangleMesh mesh;
  for (int face = 0; face < 6; ++face) {
    const int axis = face % 3, n = 2 + face;
    const double side = face < 3 ? 1.0 : -1.0;
    const auto corner = [&](int i, int k) {
      Vector3d p;
      p[axis] = side * half_size[axis];
      p[(axis + 1) % 3] = side * half_size[(axis + 1) % 3] * (2.0 * i / n - 1.0);
      p[(axis + 2) % 3] = half_size[(axis + 2) % 3] * (2.0 * k / n - 1.0);
      return p;
    };
    for (int i = 0; i < n; ++i) {
      for (int k = 0; k < n; ++k)
        addQuad(mesh, {corner(i, k), corner(i + 1, k), corner(i + 1, k + 1), corner(i, k + 1)});
    }
  }
  return mesh;
}

}  // namespace sdf_ccd::test
