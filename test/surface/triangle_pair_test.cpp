#include "surface/triangle_pair.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/triangle_distance.h"
#include "surface/triangle_pairs_scalar.h"

namespace sdf_ccd::triangle_pair_test {

using test::exact;
using test::Random;
using test::Real;
using test::Triangle3r;

enum class Kind { kGeneral, kWhole, kNear, kThin, kParallel };

/// Two random triangles: in general position; with small integer coordinates, so that many are parallel, coplanar, of
/// no area, or touch; nearly touching; thin; with parallel edges.
std::pair<Corners, Corners> draw(Random& random, Kind kind) {
  Corners a, b;
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      a[i][k] = kind == Kind::kWhole ? double(random() % 3) : test::uniform(random, -1, 1);
      b[i][k] = kind == Kind::kWhole ? double(random() % 3) : test::uniform(random, -1, 1);
    }
  if (kind == Kind::kThin) a[2] = a[0] + test::uniform(random, 0, 1) * (a[1] - a[0]) + 1e-7 * test::direction(random);
  if (kind == Kind::kParallel)
    b[1] = b[0] + test::uniform(random, -2, 2) * (a[1] - a[0]) + 1e-9 * test::direction(random);
  if (kind == Kind::kNear) {
    const Vector3d shift = closestPoints(a, b).on_a - closestPoints(a, b).on_b;
    for (Vector3d& p : b) p += (1.0 - test::uniform(random, 0, 1e-4)) * shift;
  }
  return {a, b};
}

constexpr Kind kKinds[] = {Kind::kGeneral, Kind::kWhole, Kind::kNear, Kind::kThin, Kind::kParallel};

TEST(TrianglePair, ClosestPointsAreNoFartherApartThanTheTriangles) {
  Random random(1);
  Real worst = 0;
  for (int trial = 0; trial < 40000; ++trial) {
    const auto [a, b] = draw(random, kKinds[trial % 5]);
    const ClosestPair closest = closestPoints(a, b);
    const Real truth = test::triangleDistance(exact(a), exact(b)), found = std::sqrt(Real(closest.distance2));
    ASSERT_GE(found, truth - 1e-15L);
    if (truth > 0) worst = std::max(worst, found - truth);
    EXPECT_NEAR((closest.on_b - closest.on_a).squaredNorm(), closest.distance2, 1e-14);
  }
  EXPECT_LT(worst, 1e-7L);
}

/// A positive gap proves that triangles are apart.
TEST(TrianglePair, GapsAreNoMoreThanDistances) {
  Random random(2);
  long tight = 0, apart = 0;
  for (int trial = 0; trial < 40000; ++trial) {
    const auto [a, b] = draw(random, kKinds[trial % 5]);
    const Real truth = test::triangleDistance(exact(a), exact(b));
    const ClosestPair closest = closestPoints(a, b);
    const double gap = gapAlong(closest.on_b - closest.on_a, a, b);
    ASSERT_LE(gap, truth + 8 * 2.3e-16L * 4);
    ASSERT_LE(gapAlong(test::direction(random), a, b), truth + 8 * 2.3e-16L * 4);
    apart += truth > 1e-4L;
    tight += truth > 1e-4L && gap > truth - 1e-7L;
  }
  EXPECT_GT(apart, 8000);
  EXPECT_GT(tight, apart - apart / 1000) << "the way between the closest points nearly always proves the distance";
}

/// A crossing point proves that triangles cross, for every displacement of one by less than the error.
TEST(TrianglePair, CrossingTrianglesCrossWhereverTheyAreDisplaced) {
  Random random(3);
  long crossing = 0;
  for (int trial = 0; trial < 40000; ++trial) {
    const auto [a, b] = draw(random, kKinds[trial % 5]);
    const double error = trial % 2 ? 1e-12 : 0.05;
    if (!crossingPoint(a, b, error)) continue;
    ++crossing;
    Corners moved = b;
    const Vector3d shift = trial % 2 ? Vector3d(Vector3d::Zero()) : Vector3d(0.9999 * error * test::direction(random));
    for (Vector3d& p : moved) p += shift;
    ASSERT_EQ(test::triangleDistance(exact(a), exact(moved)), 0.0L);
  }
  EXPECT_GT(crossing, 400);
}

/// A narrow triangle whose normal is mostly rounding, and an edge far from where its two long edges meet: on one side
/// of the triangle's plane, or through it.
TEST(TrianglePair, EdgesBesideNarrowTrianglesDoNotPierceThem) {
  Random random(6);
  const auto height = [](const Corners& t, const Vector3d& p) {
    const Triangle3r e = exact(t);
    return (e[1] - e[0]).cross(e[2] - e[0]).dot(p.cast<Real>() - e[0]);
  };
  const auto uniform = [&](double low, double high) { return test::uniform(random, low, high); };
  constexpr double kError = 4e-12;
  long pierced = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const Isometry3d X = test::pose(random, 3.0, 0.0);
    const double width = std::pow(10.0, uniform(-10.5, -3.0)), middle = uniform(0.5, 1.0);
    const Vector3d corner = X * Vector3d(middle, width, 0.0);
    const Corners t = {Vector3d::Zero(), X * Vector3d(1.0, 0.0, 0.0), corner};
    const double along = uniform(0.5, 0.9) * middle, low = std::pow(10.0, uniform(-12.0, -4.0));
    const Vector3d foot(along, 0.4 * width * along / middle, 0.0), up = Vector3d::UnitZ();
    const Vector3d p = X * (foot + low * up), q = X * (foot + 0.1 * up), below = X * (foot - 0.1 * up);
    const bool is_beside = height(t, p) * height(t, q) > 0.0L;
    ASSERT_FALSE(is_beside && piercedPoint(t, p, q, kError)) << width << " m wide, " << low << " m below the edge";
    pierced += width > 1e-7 && piercedPoint(t, below, q, kError);
  }
  EXPECT_GT(pierced, 30000);
}

TEST(TrianglePair, LanesAreAsOneByOne) {
  Random random(4);
  for (int trial = 0; trial < 5000; ++trial) {
    TrianglePairs lanes;
    const int size = 1 + trial % TrianglePairs::kSize;
    for (int i = 0; i < size; ++i) {
      const auto [a, b] = draw(random, kKinds[(trial + i) % 5]);
      lanes.add(a, b);
    }
    TrianglePairs scalar = lanes;
    const EndPoses poses{test::pose(random, 0.01, 0.01), test::pose(random, 0.01, 0.01)};
    const Vector3d direction = test::direction(random);
    planeGaps(poses, direction, lanes);
    planeGapsOneByOne(poses, direction, scalar);
    for (int i = 0; i < size; ++i) {
      // Normals of triangles with hardly any area are mostly rounding.
      if (kKinds[(trial + i) % 5] != Kind::kGeneral && kKinds[(trial + i) % 5] != Kind::kNear) continue;
      ASSERT_NEAR(lanes.gap[i], scalar.gap[i], 1e-7) << trial;
    }
    closestGaps(poses, lanes);
    closestGapsOneByOne(poses, scalar);
    for (int i = 0; i < size; ++i) {
      ASSERT_NEAR(std::sqrt(lanes.distance2[i]), std::sqrt(scalar.distance2[i]), 1e-7) << trial;
      if (scalar.distance2[i] > 1e-4) {
        ASSERT_NEAR(lanes.gap[i], scalar.gap[i], 1e-5) << trial;
      }
    }
    edgeGaps(poses, lanes);
    edgeGapsOneByOne(poses, scalar);
    for (int i = 0; i < size; ++i) {
      if (kKinds[(trial + i) % 5] != Kind::kGeneral && kKinds[(trial + i) % 5] != Kind::kNear) continue;
      ASSERT_NEAR(lanes.gap[i], scalar.gap[i], 1e-5) << trial;
    }
  }
}

/// Gaps are lower bounds at both ends of an interval, compared with distances in long double.
TEST(TrianglePair, LanesGapsHoldAtBothEnds) {
  Random random(5);
  for (int trial = 0; trial < 5000; ++trial) {
    TrianglePairs pairs;
    std::vector<std::pair<Corners, Corners>> drawn;
    for (int i = 0; i < TrianglePairs::kSize; ++i) {
      drawn.push_back(draw(random, kKinds[(trial + i) % 5]));
      pairs.add(drawn.back().first, drawn.back().second);
    }
    const EndPoses poses{test::pose(random, 0.1, 0.1), test::pose(random, 0.1, 0.1)};
    for (const int kind : {0, 1, 2}) {
      if (kind == 0) planeGaps(poses, test::direction(random), pairs);
      if (kind == 1) closestGaps(poses, pairs);
      if (kind == 2) edgeGaps(poses, pairs);
      for (int i = 0; i < pairs.size; ++i) {
        if (pairs.gap[i] < 0.0) continue;
        for (const Isometry3d& X : {poses.X_AB_start, poses.X_AB_end}) {
          const Triangle3r a = exact(drawn[i].first), b = exact(drawn[i].second, X);
          ASSERT_LE(pairs.gap[i], test::triangleDistance(a, b) + 32 * 2.3e-16L * 4);
        }
      }
    }
  }
}

}  // namespace sdf_ccd::triangle_pair_test
