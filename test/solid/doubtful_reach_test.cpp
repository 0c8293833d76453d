#include "solid/doubtful_reach.h"

#include <gtest/gtest.h>

#include "oracle/box_union.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd::doubtful_reach_test {

using namespace test;

TEST(DoubtfulReach, IsTheLargestDistanceOfAPoint) {
  TriangleMesh floor;
  floor.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  floor.triangles = {{0, 1, 2}, {0, 2, 3}};
  const TriangleTree tree(floor);
  const auto reachOf = [&](const Corners& t) { return reachFrom(tree, {t}, 1e-5); };
  EXPECT_LE(reachOf({Vector3d(-0.05, 0, 0), Vector3d(0.05, 0.03, 0), Vector3d(0, 0.06, 0)}), 1.01e-5)
      << "over both triangles";
  const double tilted = reachOf({Vector3d(-0.5, 0, 0), Vector3d(0.5, 0.3, 0), Vector3d(0, 0.6, 0.2)});
  EXPECT_GE(tilted, 0.2);
  EXPECT_LE(tilted, 0.2201);
  const double beside = reachOf({Vector3d(0.9, 0, 0), Vector3d(1.3, 0.1, 0), Vector3d(1.2, -0.1, 0)});
  EXPECT_GE(beside, 0.3);
  EXPECT_LE(beside, 0.3301);
  const double sliver = reachOf({Vector3d(-0.9, -0.9, 0), Vector3d(0.9, 0.9, 0), Vector3d(0.9, 0.9, 1e-5)});
  EXPECT_GE(sliver, 1e-5);
  EXPECT_LE(sliver, 2.2e-5);
}

/// Boxes of which faces nearly coincide: of some slivers it is not certain whether they lie inside. No depth is wrong
/// by more than their reach.
TEST(DoubtfulReach, BoundsTheErrorOfDepths) {
  Random random(5);
  int cases = 0, inside = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<OrientedBox> boxes;
    TriangleMesh all;
    const double noise = std::pow(10.0, uniform(random, -11.0, -6.0));
    for (int k = 0; k < 3; ++k) {
      OrientedBox box = boxAt(Vector3d(0.1 * k, 0.0, 0.05 * k), {0.1, 0.1, 0.1});
      box.X_WB = test::pose(random, noise, noise) * box.X_WB;
      boxes.push_back(box);
      all = merged(all, transformed(boxMesh(box.half_size), box.X_WB));
    }
    const Solid solid(all);
    const SolidReport& report = solid.report();
    if (!(report.doubtful_area > 0.0) || report.doubtful_reach > 1e-4) continue;
    ++cases;
    for (int k = 0; k < 300; ++k) {
      const Vector3d p(uniform(random, -0.1, 0.3), uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.2));
      const double truth = -distanceToUnion(boxes, p);
      if (!(truth > 1e-6)) continue;
      ++inside;
      const double depth = solid.tree().closestPoint(p).distance;
      ASSERT_LE(depth, truth + 4.0 * noise + 1e-9);
      ASSERT_LE(truth, depth + report.doubtful_reach + 4.0 * noise + 1e-9) << p.transpose();
    }
  }
  EXPECT_GT(cases, 10);
  EXPECT_GT(inside, 1000);
}

}  // namespace sdf_ccd::doubtful_reach_test
