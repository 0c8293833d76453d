#include "precision/exact_surface.h"

#include <cmath>

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::precision::exact_surface_test {

TEST(ExactSurface, SegmentsMeetABoxWhereItsFacesAre) {
  const Vector3d half(0.3, 0.2, 0.1);
  const TriangleMesh mesh = test::boxMesh(half);
  const ExactSurface box(mesh);
  test::Random random(1);
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const Segment segment{0.9 * test::direction(random), 0.9 * test::direction(random)};
    // The expected result, by the slab method.
    const Vector3d way = segment.end - segment.start;
    double enter = 0.0, exit = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double a = (-half[k] - segment.start[k]) / way[k], b = (half[k] - segment.start[k]) / way[k];
      enter = std::max(enter, std::min(a, b));
      exit = std::min(exit, std::max(a, b));
    }
    const std::optional<double> found = box.firstHit(segment);
    ASSERT_EQ(found.has_value(), enter <= exit) << i;
    if (!found) continue;
    EXPECT_NEAR(*found, enter, 1e-12);
    ++hits;
  }
  EXPECT_GT(hits, 100);
}

TEST(ExactSurface, NothingSlipsThroughEdgesAndCorners) {
  const TriangleMesh mesh = test::icosphere(0.5, 3);
  const ExactSurface ball(mesh);
  test::Random random(2);
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d& a = mesh.vertices[t[0]];
    const Vector3d on_edge = a + test::uniform(random, 0.0, 1.0) * (mesh.vertices[t[1]] - a);
    for (const Vector3d& target : {a, on_edge}) {
      // A radial segment: the first empty sphere reaches exactly to the edge.
      const Segment segment{3.0 * target, Vector3d::Zero()};
      const std::optional<double> hit = ball.firstHit(segment);
      ASSERT_TRUE(hit.has_value());
      EXPECT_LT((segment.start + *hit * (segment.end - segment.start) - target).norm(), 1e-9);
    }
  }
}

TEST(ExactSurface, MissesWhatItDoesNotReach) {
  const TriangleMesh mesh = test::boxMesh({0.3, 0.2, 0.1});
  const ExactSurface box(mesh);
  EXPECT_FALSE(box.firstHit({{1, 0, 0}, {0.31, 0, 0}}));
  EXPECT_FALSE(box.firstHit({{1, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(box.firstHit({{0.1, 0, 0}, {0.2, 0, 0}}));
  EXPECT_NEAR(box.distance({0.1, 0.0, 0.0}), -0.1, 1e-15);
}

}  // namespace sdf_ccd::precision::exact_surface_test
