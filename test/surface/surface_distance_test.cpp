#include "surface/surface_distance.h"

#include <gtest/gtest.h>

#include "cancel_moments.h"
#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/shapes.h"
#include "sdf_ccd/primitive.h"

namespace sdf_ccd::surface_distance_test {

using test::Random;
using test::Real;
using test::treeOf;
using test::Triangle3r;
using test::Vector3r;

/// A sphere with random bumps: not convex, and nowhere flat.
TriangleMesh bumpySphere(Random& random, double radius, int subdivisions) {
  TriangleMesh mesh = test::icosphere(radius, subdivisions);
  for (Vector3d& v : mesh.vertices) v *= test::uniform(random, 0.6, 1.4);
  return mesh;
}

/// By brute force over all pairs of triangles, in long double.
Real trueDistance(const BoxTree& a, const BoxTree& b, const Isometry3d& X_AB) {
  Real least = 1e300L;
  for (int i = 0; i < int(a.size()); ++i)
    for (int j = 0; j < int(b.size()); ++j) least = std::min(least, test::distance(a.triangle(i), b.triangle(j), X_AB));
  return std::max<Real>(least, 0);
}

/// Distance of a point from a surface.
Real distanceFrom(const BoxTree& tree, const Vector3d& p) {
  Real least = 1e300L;
  const Vector3r q = p.cast<Real>();
  for (int i = 0; i < int(tree.size()); ++i) {
    const Triangle3r t = test::exact(tree.triangle(i).corners);
    least = std::min(least, std::abs(test::triangleDistance(t, {q, q, q}) - tree.triangle(i).radius));
  }
  return least;
}

TEST(SurfaceDistance, IsThatOfAllPairsOfTrianglesWithPointsOnBothSurfaces) {
  Random random(7);
  int apart = 0, crossing = 0;
  SeparationMemory memory;
  for (int i = 0; i < 20; ++i) {
    const double radius = i % 3 == 0 ? 0.02 : 0.0;
    const BoxTree a = treeOf(bumpySphere(random, 0.2, 1), radius), b = treeOf(bumpySphere(random, 0.1, 1));
    SeparationWitness witness;
    Isometry3d X_AB = test::pose(random, 3.0, 0.5);
    for (int k = 0; k < 4; ++k) {  // the previous query's witness must not change the result
      X_AB = X_AB * test::pose(random, 0.1, 0.05);
      const Real truth = trueDistance(a, b, X_AB);
      const auto found = surfaceDistance(a, b, X_AB, 1e3, witness, memory);
      ASSERT_TRUE(found);
      EXPECT_NEAR(found->distance, double(truth), 1e-9);
      EXPECT_NEAR((found->q_A - found->p_A).norm(), found->distance, 1e-12);
      if (truth > 0) {
        ++apart;
        EXPECT_LT(distanceFrom(a, found->p_A), 1e-9);
        EXPECT_LT(distanceFrom(b, X_AB.inverse() * found->q_A), 1e-9);
      } else {
        ++crossing;
      }
      // Surfaces beyond the limit give no result.
      SeparationWitness none;
      const double limit = test::uniform(random, 0.0, 0.4);
      const auto near = surfaceDistance(a, b, X_AB, limit, none, memory);
      ASSERT_EQ(bool(near), double(truth) < limit) << double(truth) << " " << limit;
      if (near) {
        EXPECT_NEAR(near->distance, double(truth), 1e-9);
      }
    }
  }
  EXPECT_GT(apart, 16);
  EXPECT_GT(crossing, 8);
}

TEST(SurfaceDistance, ASlabHasEitherSurfaceOnItsOwnSide) {
  Random random(8);
  int found = 0;
  for (int i = 0; i < 60; ++i) {
    const BoxTree a = treeOf(bumpySphere(random, 0.2, 1)), b = treeOf(bumpySphere(random, 0.1, 1));
    const Isometry3d X_AB = test::pose(random, 3.0, 0.7);
    SeparationWitness witness;
    SeparationMemory memory;
    const SurfaceDistance nearest = *surfaceDistance(a, b, X_AB, 1e3, witness, memory);
    const auto width = slabBetween(a, b, X_AB, nearest);
    if (!width) continue;
    ++found;
    const Vector3d n = (nearest.q_A - nearest.p_A).normalized();
    double reach_a = -1e300, begin_b = 1e300;
    for (int k = 0; k < int(a.size()); ++k)
      for (const Vector3d& p : a.triangle(k).corners) reach_a = std::max(reach_a, n.dot(p));
    for (int k = 0; k < int(b.size()); ++k)
      for (const Vector3d& p : b.triangle(k).corners) begin_b = std::min(begin_b, n.dot(X_AB * p));
    EXPECT_LE(*width, begin_b - reach_a);
    EXPECT_GE(*width, 0.85 * nearest.distance);
  }
  EXPECT_GT(found, 10);
}

/// Far from their frames' origins, coordinates are rounded by more than boxes near each other are.
TEST(SurfaceDistance, SlabsHoldFarFromTheOrigin) {
  Random random(5);
  int found = 0;
  for (const double far : {1.0, 1e3, 1e6}) {
    for (int i = 0; i < 100; ++i) {
      constexpr double kHalf = 0.001;
      const Vector3d a_center = far * test::direction(random), b_center = far * test::direction(random);
      const BoxTree a = treeOf(test::translated(test::boxMesh({kHalf, kHalf, kHalf}), a_center));
      const BoxTree b = treeOf(test::translated(test::icosphere(0.5 * kHalf, 1), b_center));
      Isometry3d X_AB = test::pose(random, 3.0, 0.0);
      const double distance = kHalf * std::pow(10.0, test::uniform(random, -6, -1));
      X_AB.translation() = a_center + Vector3d(0, 0, 1.5 * kHalf + distance) - X_AB.linear() * b_center;
      SeparationWitness witness;
      SeparationMemory memory;
      const auto nearest = surfaceDistance(a, b, X_AB, 1e3, witness, memory);
      const auto width = slabBetween(a, b, X_AB, *nearest);
      if (!width) continue;
      ++found;
      EXPECT_LE(*width, trueDistance(a, b, X_AB)) << far << " " << distance;
    }
  }
  EXPECT_GT(found, 150);
}

/// The end discs of two coaxial cylinders, as of wheels on one axle: all pairs of their triangles are as far apart.
TEST(SurfaceDistance, FacesThatLieOppositeTakeNoLongerThanOthers) {
  const BoxTree wheel = treeOf(tessellate(Cylinder::fromRadiusAndLength(0.3, 0.1), 2e-6), 0.0);
  SeparationMemory memory;
  for (const double tilt : {0.0, 1e-9, 1e-6}) {
    for (const double turn : {0.0, 0.3}) {
      Isometry3d X_AB = Isometry3d::Identity();
      X_AB.translation() = Vector3d(0, 0, 0.2);
      X_AB.rotate(Eigen::AngleAxisd(tilt, Vector3d::UnitX()) * Eigen::AngleAxisd(turn, Vector3d::UnitZ()));
      SeparationWitness witness;
      std::optional<SurfaceDistance> found;
      const double seconds =
          test::secondsOf([&] { found = surfaceDistance(wheel, wheel, X_AB, 1.0, witness, memory); });
      ASSERT_TRUE(found);
      const double truth = 0.2 - 0.05 - 0.05 * std::cos(tilt) - 0.3 * std::sin(tilt);
      EXPECT_LE(found->slack, 5e-5);
      EXPECT_GE(found->distance, truth - 1e-9);
      EXPECT_LE(found->distance - found->slack, truth + 2.1e-6 * tilt + 1e-9);
      EXPECT_LT(seconds, 0.005 * test::slowness());
    }
  }
}

/// Before anything is found the range is all that ends the search, and nothing within it may be left out: two wheels
/// face each other at a small angle, and a single place is barely within range.
TEST(SurfaceDistance, WhatIsBarelyWithinRangeIsFoundAmongManyThatAreNot) {
  const BoxTree wheel = treeOf(tessellate(Cylinder::fromRadiusAndLength(0.3, 0.1), 2e-6), 0.0);
  SeparationMemory memory;
  for (const double tilt : {1e-8, 1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 1e-3}) {
    for (const double beyond : {1e-8, 1e-7, 1e-6, 4e-6}) {
      Isometry3d X_AB = Isometry3d::Identity();
      X_AB.translation() = Vector3d(0, 0, 0.2);
      X_AB.rotate(Eigen::AngleAxisd(tilt, Vector3d::UnitX()) * Eigen::AngleAxisd(0.3, Vector3d::UnitZ()));
      const double truth = 0.2 - 0.05 - 0.05 * std::cos(tilt) - 0.3 * std::sin(tilt);
      const double of_tessellation = 2.1e-6 * std::sin(tilt) + 1e-12;  // its radius is smaller by at most that
      SeparationWitness witness;
      const auto found = surfaceDistance(wheel, wheel, X_AB, truth + of_tessellation + beyond, witness, memory);
      ASSERT_TRUE(found) << tilt << " " << beyond;
      EXPECT_LE(found->distance, truth + of_tessellation + beyond);
    }
  }
}

}  // namespace sdf_ccd::surface_distance_test
