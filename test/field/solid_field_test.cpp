#include <gtest/gtest.h>

#include "field/signed_surface.h"
#include "oracle/box_union.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::solid_field_test {

using test::boxAt;
using test::OrientedBox;
using test::Random;

/// Two boxes of 1.0 × 0.6 × 0.6 m that overlap by half, in one mesh: 1.5 × 0.6 × 0.6 m together.
TriangleMesh overlappingBoxes() {
  return test::meshOf({boxAt({-0.25, 0, 0}, {0.5, 0.3, 0.3}), boxAt({0.25, 0, 0}, {0.5, 0.3, 0.3})});
}

double distanceToUnion(const Vector3d& p) {
  const Vector3d q = p.cwiseAbs() - Vector3d(0.75, 0.3, 0.3);
  return q.cwiseMax(0).norm() + std::min(q.maxCoeff(), 0.0);
}

TEST(FieldOfASolid, DepthIsThatInOverlappingPartsTogether) {
  const TriangleMesh mesh = overlappingBoxes();
  FieldOptions adaptive, uniform;
  adaptive.max_error = 0.01;
  uniform.cells = 40;
  for (const FieldOptions& options : {adaptive, uniform}) {
    const DistanceField field = buildField(mesh, options);
    Random random(1);
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p = test::uniformIn(random, {Vector3d(-0.9, -0.45, -0.45), Vector3d(0.9, 0.45, 0.45)});
      const FieldSample sample = field.sample(p);
      ASSERT_NEAR(sample.value, distanceToUnion(p), sample.error * (1 + 1e-9));
    }
    // On a face of one box, inside the other box.
    const FieldSample deep = field.sample({0.25, 0.1, 0.1});
    EXPECT_NEAR(deep.value, -0.2, deep.error);
    EXPECT_LT(deep.value + deep.error, -0.02);
  }
}

TEST(FieldOfASolid, SignedDistancesAreThoseToTheUnionOfBoxes) {
  Random random(3);
  for (int i = 0; i < 40; ++i) {
    std::vector<OrientedBox> boxes;
    for (int k = 0; k < 5; ++k) {  // on a lattice, so that faces and edges coincide
      const auto step = [&](int from, int steps) { return 0.05 * (from + static_cast<int>(random() % steps)); };
      boxes.push_back(boxAt({step(-3, 7), step(-3, 7), step(-3, 7)}, {step(1, 4), step(1, 4), step(1, 4)}));
    }
    const TriangleMesh mesh = test::meshOf(boxes);
    const SignedSurface surface(mesh);
    for (int k = 0; k < 100; ++k) {
      const Vector3d p = test::uniformIn(random, boundingBox(mesh));
      ASSERT_NEAR(surface.signedDistance(p), test::distanceToUnion(boxes, p), 1e-12);
    }
  }
}

TEST(FieldOfASolid, SignedDistancesOfCrossedBarsAreExact) {
  // Axis-aligned bars that cross: the deepest points are far from the boundary, but not from faces inside another bar.
  const SignedSurface surface(test::meshOf(
      {boxAt({0, 0, 0}, {0.5, 0.1, 0.1}), boxAt({0, 0, 0}, {0.1, 0.5, 0.1}), boxAt({0, 0, 0}, {0.1, 0.1, 0.5})}));
  // The boundary's point nearest to the middle is on an edge where two bars meet.
  EXPECT_NEAR(surface.signedDistance({0, 0, 0}), -std::sqrt(0.02), 1e-12);
  EXPECT_NEAR(surface.signedDistance({0.1, 0, 0}), -0.1, 1e-12);
  EXPECT_NEAR(surface.signedDistance({0.2, 0.2, 0}), 0.1, 1e-12);
}

}  // namespace sdf_ccd::solid_field_test
