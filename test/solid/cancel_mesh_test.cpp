// Meshes that no robot should have, but some do: unloading must not wait until such a mesh has been processed.
#include "cancel_moments.h"
#include "oracle/hostile_meshes.h"
#include "oracle/shapes.h"
#include "sdf_ccd/mesh.h"
#include "solid/closed_solid.h"

namespace sdf_ccd::cancel_mesh_test {

using namespace test;

constexpr double kSoon = 0.1;  // of the 0.2 s that unloading may take [s]

/// Each triangle with vertices of its own, as STL files have them.
TriangleMesh soupOf(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const Vector3i& t : mesh.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int i = 0; i < 3; ++i) soup.vertices.push_back(mesh.vertices[t[i]]);
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  return soup;
}

TEST(CancelMesh, WeldingEndsSoon) {
  const TriangleMesh soup = soupOf(torusMesh(0.3, 0.1, 2000, 500));
  ASSERT_EQ(soup.triangles.size(), 2000000u);
  expectEndsSoon([&] { welded(soup); }, 10, kSoon);
}

TEST(CancelMesh, OrientingEndsSoon) {
  const TriangleMesh soup = soupOf(torusMesh(0.3, 0.1, 800, 250));
  ASSERT_EQ(soup.triangles.size(), 400000u);
  expectEndsSoon([&] { orientOutward(soup); }, 8, kSoon);
}

TEST(CancelMesh, OrientingLoosePartsEndsSoon) {
  TriangleMesh soup = soupOf(torusMesh(0.3, 0.1, 200, 250));
  // A gap about each triangle, so that none has a neighbour.
  for (const Vector3i& t : soup.triangles) {
    const Vector3d center = (soup.vertices[t[0]] + soup.vertices[t[1]] + soup.vertices[t[2]]) / 3.0;
    for (int i = 0; i < 3; ++i) soup.vertices[t[i]] += 0.01 * (center - soup.vertices[t[i]]);
  }
  ASSERT_EQ(soup.triangles.size(), 100000u);
  expectEndsSoon([&] { orientOutward(soup); }, 8, kSoon);
}

/// Few triangles, so that the moments reach the end, and many, with which each step takes long.
void expectClosingEndsSoon(const std::function<TriangleMesh(int triangles)>& mesh) {
  for (const int triangles : {200, 20000}) {
    const auto solid = std::make_shared<const Solid>(mesh(triangles));
    expectEndsSoon([&] { ClosedSolid{solid}; }, 5, kSoon);
  }
}

/// Its open edges all meet in two points.
TEST(CancelMesh, ClosingAStarEndsSoon) {
  expectClosingEndsSoon(starMesh);
}

TEST(CancelMesh, ClosingNeedlesEndsSoon) {
  expectClosingEndsSoon([](int triangles) { return needlesMesh(triangles, 0.002); });
}

TEST(CancelMesh, OrientingRandomTrianglesEndsSoon) {
  const TriangleMesh mesh = randomTrianglesMesh(3000);
  expectEndsSoon([&] { orientOutward(mesh); }, 8, kSoon);
}

TEST(CancelMesh, TheSolidOfNestedShellsEndsSoon) {
  const TriangleMesh shells = orientOutward(nestedMesh(1000)).mesh;
  expectEndsSoon([&] { Solid solid(shells); }, 8, kSoon);
}

}  // namespace sdf_ccd::cancel_mesh_test
