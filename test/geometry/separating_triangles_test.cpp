#include "sdf_ccd/geometry/separating_triangles.h"

#include <numeric>

#include <gtest/gtest.h>

#include "oracle/shapes.h"

namespace sdf_ccd {
namespace {

std::vector<std::uint8_t> separating(const TriangleMesh& mesh) {
  const auto tree = std::make_shared<const TriangleTree>(mesh);
  return separatingTriangles(mesh, *tree, Interior(mesh, tree));
}

int count(const TriangleMesh& mesh) {
  const std::vector<std::uint8_t> separates = separating(mesh);
  return std::accumulate(separates.begin(), separates.end(), 0);
}

TEST(SeparatingTriangles, AllOfASoundMesh) {
  for (const TriangleMesh& mesh :
       {test::boxMesh({0.2, 0.1, 0.3}), test::icosphere(0.3, 3), test::torusMesh(0.2, 0.08, 32, 16),
        test::boxMesh({0.2, 0.1, 1e-6}), test::translated(test::icosphere(1e-4, 2), {100, 0, 0})}) {
    EXPECT_EQ(count(mesh), static_cast<int>(mesh.triangles.size()));
  }
}

TEST(SeparatingTriangles, NoneOfAMeshInsideOut) {
  EXPECT_EQ(count(test::flipped(test::icosphere(0.3, 2))), 0);
}

TEST(SeparatingTriangles, NoneWithinAnotherSolid) {
  const TriangleMesh outer = test::boxMesh({0.3, 0.3, 0.3}), inner = test::icosphere(0.1, 2);
  EXPECT_EQ(count(merged(outer, inner)), static_cast<int>(outer.triangles.size()));
  // A cavity's wall does.
  EXPECT_EQ(count(merged(outer, test::flipped(inner))),
            static_cast<int>(outer.triangles.size() + inner.triangles.size()));
}

TEST(SeparatingTriangles, NotThoseThatAreCut) {
  // A bar through two walls of a box: it cuts a triangle or two of each, all its own sides are cut, its caps are free.
  const TriangleMesh mesh = merged(test::boxMesh({0.1, 0.1, 0.1}), test::boxMesh({0.01, 0.02, 0.3}));
  const std::vector<std::uint8_t> separates = separating(mesh);
  int box = 0, bar = 0;
  for (int i = 0; i < 12; ++i) box += separates[i];
  for (int i = 12; i < 24; ++i) {
    bar += separates[i];
    const bool cap = std::abs(areaNormal(mesh, i).normalized().z()) > 0.5;
    EXPECT_EQ(separates[i], cap) << i;
  }
  EXPECT_EQ(box, 8);
  EXPECT_EQ(bar, 4);
}

TEST(SeparatingTriangles, NotWhereFacesLieOnEachOther) {
  // Two boxes that share a wall.
  const TriangleMesh mesh =
      merged(test::boxMesh({0.1, 0.1, 0.1}), test::translated(test::boxMesh({0.1, 0.1, 0.1}), {0.2, 0, 0}));
  for (int i = 0; i < 24; ++i) {
    const Vector3d x = Vector3d::UnitX();
    const bool shared_wall = areaNormal(mesh, i).normalized().dot(i < 12 ? x : -x) > 0.5;
    if (shared_wall) {
      EXPECT_EQ(separating(mesh)[i], 0);
    }
  }
}

TEST(SeparatingTriangles, NotAtAHole) {
  TriangleMesh open = test::icosphere(0.3, 3);
  const Vector3i removed = open.triangles.back();
  open.triangles.pop_back();
  const std::vector<std::uint8_t> separates = separating(open);
  int neighbours = 0;
  for (std::size_t i = 0; i < open.triangles.size(); ++i) {
    int shared = 0;
    for (int k = 0; k < 3; ++k) shared += (open.triangles[i].array() == removed[k]).any();
    neighbours += shared == 2;
    EXPECT_EQ(separates[i], shared != 2);
  }
  EXPECT_EQ(neighbours, 3);
}

}  // namespace
}  // namespace sdf_ccd
