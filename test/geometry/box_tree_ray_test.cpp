#include "geometry/box_tree_ray.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/triangle_tree.h"
#include "oracle/random.h"
#include "sdf_ccd/geometry/primitive.h"

namespace sdf_ccd {
namespace {

using namespace test;

BoxTree treeOf(const TriangleMesh& mesh, double radius = 0.0) {
  std::vector<RoundedTriangle> triangles;
  for (const Vector3i& t : mesh.triangles)
    triangles.push_back({{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}, radius});
  return BoxTree(std::move(triangles));
}

TEST(BoxTreeRay, SeesOutOfNothingClosed) {
  constexpr double kRadius = 0.1, kDeviation = 1e-4;
  Random random(1);
  for (const Primitive& shape : {Primitive(Sphere{kRadius}), Primitive(Box{{kRadius, kRadius, kRadius}})}) {
    const TriangleMesh mesh = tessellate(shape, kDeviation);
    const BoxTree tree = treeOf(mesh);
    for (int i = 0; i < 300; ++i) {
      const Vector3d d = direction(random);
      EXPECT_FALSE(seesOutside(tree, uniform(random, 0.0, 0.98) * kRadius * d));
      EXPECT_TRUE(seesOutside(tree, std::sqrt(3.0) * (1.001 + uniform(random, 0.0, 3.0)) * kRadius * d));
    }
  }
}

/// A cube without its top, seen through its opening.
TEST(BoxTreeRay, SeesOutOfAnOpeningAsTheTriangleTreeDoes) {
  TriangleMesh mesh = tessellate(Box{{0.1, 0.1, 0.1}}, 1.0);
  const auto isTop = [&](const Vector3i& t) {
    return std::all_of(t.data(), t.data() + 3, [&](int v) { return mesh.vertices[v].z() > 0.0; });
  };
  mesh.triangles.erase(std::remove_if(mesh.triangles.begin(), mesh.triangles.end(), isTop), mesh.triangles.end());
  const BoxTree tree = treeOf(mesh);
  const TriangleTree oracle(mesh);
  Random random(2);
  int differ = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = uniformIn(random, {Vector3d::Constant(-0.09), Vector3d::Constant(0.09)});
    differ += seesOutside(tree, p) != oracle.seesOutside(p);
  }
  EXPECT_EQ(differ, 0);
  EXPECT_TRUE(seesOutside(tree, Vector3d::Zero()));
}

/// The gap between two cubes is narrowed by the triangles' radius until no ray fits through.
TEST(BoxTreeRay, RoundedTrianglesAreThick) {
  const TriangleMesh mesh = tessellate(Box{{0.1, 0.1, 0.1}}, 1.0);
  TriangleMesh slit = mesh;
  for (Vector3d& p : slit.vertices) p.x() += 0.21;  // 10 mm beside the other cube
  const Vector3d between(0.105, 0.0, 0.0);
  EXPECT_TRUE(seesOutside(treeOf(merged(mesh, slit)), between));
  EXPECT_TRUE(seesOutside(treeOf(merged(mesh, slit), 0.002), between));
  EXPECT_FALSE(seesOutside(treeOf(merged(mesh, slit), 0.00499), between));
}

}  // namespace
}  // namespace sdf_ccd
