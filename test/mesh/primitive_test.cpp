#include "sdf_ccd/primitive.h"

#include <limits>
#include <stdexcept>
#include <type_traits>

#include <gtest/gtest.h>

#include "mesh/triangle_tree.h"
#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::primitive_test {

const std::vector<Primitive> kSolids = {Sphere{0.5}, Box::fromSize({0.4, 0.6, 1.4}),
                                        Cylinder::fromRadiusAndLength(0.3, 1.2),
                                        Cylinder::fromRadiusAndLength(0.6, 0.2)};

// Half sizes in braces, as they were, do not compile.
static_assert(!std::is_aggregate_v<Box> && !std::is_constructible_v<Box, Vector3d>);
static_assert(!std::is_aggregate_v<Cylinder> && !std::is_constructible_v<Cylinder, double, double>);

TEST(Primitive, SizesAreFull) {
  const Box box = Box::fromSize({2, 4, 6});
  EXPECT_EQ(box.size, Vector3d(2, 4, 6));
  EXPECT_EQ(boundingBox(box).max(), Vector3d(1, 2, 3));
  const Cylinder cylinder = Cylinder::fromRadiusAndLength(1, 4);
  EXPECT_EQ(cylinder.length, 4);
  EXPECT_EQ(boundingBox(cylinder).max(), Vector3d(1, 1, 2));
}

TEST(Primitive, ClosedForms) {
  EXPECT_DOUBLE_EQ(signedDistance(Sphere{2}, {0, 3, 4}), 3);
  EXPECT_DOUBLE_EQ(signedDistance(Box::fromSize({2, 4, 6}), {4, 6, 3}), 5);
  EXPECT_DOUBLE_EQ(signedDistance(Box::fromSize({2, 4, 6}), {0, 0, 0}), -1);
  EXPECT_DOUBLE_EQ(signedDistance(Cylinder::fromRadiusAndLength(1, 4), {4, 0, 6}), 5);
  EXPECT_DOUBLE_EQ(signedDistance(Cylinder::fromRadiusAndLength(1, 4), {0.25, 0, 1.5}), -0.5);
  EXPECT_DOUBLE_EQ(signedDistance(HalfSpace{{0, 0, 1}, 0.5}, {7, 8, 2}), 1.5);
}

TEST(Primitive, DistanceIsExactAgainstAFineMesh) {
  test::Random random(1);
  for (const Primitive& solid : kSolids) {
    const double deviation = 2e-5;
    const TriangleTree tree(tessellate(solid, deviation));
    for (int i = 0; i < 500; ++i) {
      const Vector3d p = test::pointInCube(random, 1.2);
      const double sign = tree.windingNumber(p) > 0.5 ? -1 : 1;
      EXPECT_NEAR(signedDistance(solid, p), sign * tree.closestPoint(p).distance, 1.01 * deviation);
    }
  }
}

TEST(Primitive, GradientIsUnitAndTheSlopeOfTheDistance) {
  test::Random random(2);
  std::vector<Primitive> solids = kSolids;
  solids.push_back(HalfSpace{Vector3d(1, 2, 3).normalized(), 0.1});
  for (const Primitive& solid : solids) {
    int smooth = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vector3d p = test::pointInCube(random, 1.2);
      const Vector3d gradient = distanceGradient(solid, p);
      ASSERT_NEAR(gradient.norm(), 1, 1e-12);
      // Stepping against the gradient by the distance lands on the surface, off the medial axis.
      const double d = signedDistance(solid, p);
      smooth += std::abs(signedDistance(solid, p - d * gradient)) < 1e-12;
    }
    EXPECT_EQ(smooth, 2000);
  }
}

TEST(Primitive, GradientOfSymmetricPointsIsUnitAndNotNan) {
  for (const Primitive& solid : kSolids) {
    EXPECT_NEAR(distanceGradient(solid, Vector3d::Zero()).norm(), 1, 1e-15);
    EXPECT_NEAR(distanceGradient(solid, boundingBox(solid).max()).norm(), 1, 1e-15);
  }
}

TEST(Primitive, DistanceIsConvexAlongLines) {
  test::Random random(3);
  for (const Primitive& solid : kSolids) {
    for (int i = 0; i < 2000; ++i) {
      const Vector3d a = test::pointInCube(random, 1), b = test::pointInCube(random, 1);
      const double middle = signedDistance(solid, (a + b) / 2);
      EXPECT_LE(middle, (signedDistance(solid, a) + signedDistance(solid, b)) / 2 + 1e-12);
    }
  }
}

TEST(Primitive, TessellationIsClosedOnTheSurfaceAndAsFineAsAsked) {
  for (const Primitive& solid : kSolids) {
    for (const double deviation : {0.05, 1e-3}) {
      const TriangleMesh mesh = tessellate(solid, deviation);
      EXPECT_NO_THROW(validate(mesh));
      EXPECT_GT(signedVolume(mesh), 0);
      for (const Vector3d& v : mesh.vertices) EXPECT_NEAR(signedDistance(solid, v), 0, 1e-14);
      for (const Vector3i& t : mesh.triangles) {
        const Vector3d middle = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
        EXPECT_LE(std::abs(signedDistance(solid, middle)), deviation);
      }
    }
  }
}

TEST(Primitive, BadSizesAreNamed) {
  EXPECT_THROW(validate(Primitive(Sphere{0})), std::invalid_argument);
  EXPECT_THROW(validate(Primitive(Box::fromSize({2, -2, 2}))), std::invalid_argument);
  EXPECT_THROW(validate(Primitive(Cylinder::fromRadiusAndLength(1, 2.0 * std::numeric_limits<double>::infinity()))),
               std::invalid_argument);
  EXPECT_THROW(validate(Primitive(HalfSpace{{0, 0, 2}, 0})), std::invalid_argument);
  EXPECT_THROW(tessellate(HalfSpace{{0, 0, 1}, 0}, 0.1), std::invalid_argument);
  EXPECT_THROW(tessellate(Sphere{1}, 0), std::invalid_argument);
  EXPECT_THROW(tessellate(Cylinder::fromRadiusAndLength(1, 2), 1e-300), std::length_error);
  EXPECT_NO_THROW(validate(Primitive(HalfSpace{{0, 0, -1}, 3})));
}

}  // namespace sdf_ccd::primitive_test
