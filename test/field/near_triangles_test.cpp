#include "field/near_triangles.h"

#include <gtest/gtest.h>

#include "field/near_octants.h"
#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::near_triangles_test {

using test::Random;

/// Compares the lists of cubes, of their octants, and of the octants of these, with the tree over all triangles.
class NearTrianglesTest : public testing::Test {
 protected:
  void expectExact(const TriangleMesh& mesh, double largest_side) {
    const SurfaceIndex index(mesh);
    surface_ = &index.exact();
    const AlignedBox3d box = boundingBox(mesh);
    for (int i = 0; i < 60; ++i) {
      const double side = largest_side * test::uniform(random_, 0.1, 1.0);
      const Vector3d margin = Vector3d::Constant(side);
      const Vector3d center = test::uniformIn(random_, {box.min() - margin, box.max() + margin});
      const NearCube cube(index, {center, side}, surface_->nearest(center));
      expectExact(cube.near(), 2);
      if (HasFatalFailure()) return;
    }
  }

  void expectExact(const NearTriangles& near, int levels) {
    const Vector3d reach = Vector3d::Constant(0.5 * near.cube().side);
    const DirectionCone cone = near.gradientCone();
    ASSERT_NEAR(near.centerDistance(), surface_->signedDistance(near.cube().center), 1e-12);
    PointLanes places;
    PointLanes::Lane distances;
    for (int k = 0; k < PointLanes::kCount; ++k) {
      const Vector3d corner = near.cube().corner(k), center = near.cube().center;
      places.set(k, k % 2 == 0 ? corner : test::uniformIn(random_, {center - reach, center + reach}));
    }
    near.signedDistances(places, PointLanes::kCount, distances);
    for (int k = 0; k < PointLanes::kCount; ++k) {
      const Vector3d p = places.at(k);
      const double exact = surface_->signedDistance(p);
      ASSERT_NEAR(distances[k], exact, 1e-12);
      ASSERT_NEAR(near.signedDistance(p), exact, 1e-12);
      if (!(cone.sine < 1.0) || std::abs(exact) < 1e-9) continue;
      ++cones_;
      const Vector3d gradient = (p - surface_->tree().closestPoint(p).point) / exact;
      ASSERT_LE(gradient.cross(cone.axis).norm(), cone.sine + 1e-6);
      ASSERT_GT(gradient.dot(cone.axis), 0.0);
    }
    if (levels == 0) return;
    NearOctants octants(near);
    for (int k = 0; k < 8; ++k) {
      ASSERT_EQ(octants.centerDistance(k), octants[k].centerDistance());
      ASSERT_LE(octants[k].size(), near.size());
      expectExact(octants[k], levels - 1);
      if (HasFatalFailure()) return;
    }
  }

  Random random_{7};
  const SignedSurface* surface_ = nullptr;
  int cones_ = 0;
};

TEST_F(NearTrianglesTest, AreExactOnSmallTriangles) {
  expectExact(test::icosphere(0.3, 4), 0.1);
  EXPECT_GT(cones_, 1000);
}

TEST_F(NearTrianglesTest, AreExactOnLargeTriangles) {
  expectExact(test::boxMesh({0.2, 0.15, 0.1}), 0.1);
  EXPECT_GT(cones_, 1000);
}

TEST_F(NearTrianglesTest, AreExactOnThinPlates) {
  expectExact(test::boxMesh({0.2, 0.15, 1e-4}), 0.05);
}

TEST_F(NearTrianglesTest, AreExactOnSlivers) {
  expectExact(test::torusMesh(0.2, 1e-5, 7, 5), 0.05);
}

TEST_F(NearTrianglesTest, AreExactWhereSolidsOverlap) {
  expectExact(merged(test::icosphere(0.1, 2), test::translated(test::boxMesh({0.1, 0.05, 0.2}), {0.05, 0.03, 0.02})),
              0.05);
}

TEST_F(NearTrianglesTest, AreExactWhereSolidsCrossAtSmallAngles) {
  // Where faces cross, an edge of several pieces is nearest to many points; one piece does not determine the side.
  for (const double angle : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const Isometry3d X(Eigen::AngleAxisd(angle, Vector3d(1, 2, 3).normalized()));
    const TriangleMesh box = test::boxMesh({0.2, 0.15, 0.1});
    expectExact(merged(box, transformed(box, X)), 0.05);
    expectExact(merged(box, transformed(test::boxMesh({0.15, 0.2, 0.1}), X)), 0.05);
  }
}

}  // namespace sdf_ccd::near_triangles_test
