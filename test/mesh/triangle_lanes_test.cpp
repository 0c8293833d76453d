#include "mesh/triangle_lanes.h"

#include <gtest/gtest.h>

#include <limits>

#include "oracle/random.h"

namespace sdf_ccd::triangle_lanes_test {

using test::Random;

struct Case {
  Vector3d a, b, c;
  PointLanes places;
};

Case randomCase(Random& random) {
  const AlignedBox3d box(Vector3d::Constant(-1.0), Vector3d::Constant(1.0));
  Case made{test::uniformIn(random, box), test::uniformIn(random, box), test::uniformIn(random, box), {}};
  for (int k = 0; k < PointLanes::kCount; ++k) made.places.set(k, 2.0 * test::uniformIn(random, box));
  // Among them corners and points in the plane.
  made.places.set(0, made.b);
  made.places.set(1, 0.5 * (made.a + made.c));
  made.places.set(2, 0.2 * made.a + 0.5 * made.b + 0.3 * made.c);
  return made;
}

TEST(TriangleLanes, WaysAreThoseFromTheClosestPoint) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const Case made = randomCase(random);
    const MeasuredTriangle triangle({made.a, made.b, made.c});
    if (triangle.sliver()) continue;
    DisplacementLanes found;
    displacements(FlatTriangle({made.a, made.b, made.c}), made.places, found);
    for (int k = 0; k < PointLanes::kCount; ++k) {
      const Vector3d way = made.places.at(k) - triangle.closest(made.places.at(k));
      ASSERT_NEAR((found.at(k) - way).norm(), 0.0, 1e-11);
      ASSERT_NEAR(found.distance2[k], way.squaredNorm(), 1e-11);
    }
  }
}

TEST(TriangleLanes, NearestOfSeveralIsKept) {
  Random random(2);
  for (int i = 0; i < 5000; ++i) {
    const PointLanes places = randomCase(random).places;
    const Vector3d axis = test::direction(random);
    ClosestLanes closest;
    closest.distance2.fill(std::numeric_limits<double>::infinity());
    PointLanes::Lane best2 = closest.distance2, side{};
    for (int n = 0; n < 5; ++n) {
      const Case made = randomCase(random);
      const MeasuredTriangle triangle({made.a, made.b, made.c});
      if (triangle.sliver()) continue;
      offer(FlatTriangle({made.a, made.b, made.c}), axis, places, closest);
      for (int k = 0; k < PointLanes::kCount; ++k) {
        const Vector3d way = places.at(k) - triangle.closest(places.at(k));
        if (way.squaredNorm() >= best2[k]) continue;
        best2[k] = way.squaredNorm();
        side[k] = way.dot(axis);
      }
    }
    for (int k = 0; k < PointLanes::kCount; ++k) {
      ASSERT_NEAR(closest.distance2[k], best2[k], 1e-11);
      ASSERT_NEAR(closest.side[k], side[k], 1e-6);
    }
  }
}

}  // namespace sdf_ccd::triangle_lanes_test
