#include "sdf_ccd/simulation.h"

#include <gtest/gtest.h>

#include <limits>

#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::mass_properties_test {

using namespace test;

TEST(MassProperties, BoxMeshEqualsClosedForm) {
  const Vector3d half(0.3, 0.2, 0.1);
  const MassProperties exact = massProperties(Primitive(Box::fromSize(2.0 * half)), 700.0);
  const MassProperties mesh = massProperties(boxMesh(half), 700.0);
  EXPECT_NEAR(mesh.mass, exact.mass, 1e-12 * exact.mass);
  EXPECT_NEAR(exact.mass, 700.0 * 0.6 * 0.4 * 0.2, 1e-12);
  EXPECT_LT((mesh.inertia - exact.inertia).norm(), 1e-13 * exact.inertia.norm());
  EXPECT_NEAR(exact.inertia(0, 0), exact.mass / 12.0 * (0.4 * 0.4 + 0.2 * 0.2), 1e-12);
  EXPECT_LT(mesh.center.norm(), 1e-15);
}

TEST(MassProperties, RotatedAndMovedMeshGivesTheRotatedTensor) {
  Random random(3);
  const Vector3d half(0.05, 0.2, 0.1);
  const MassProperties exact = massProperties(Primitive(Box::fromSize(2.0 * half)), 1.0);
  for (int i = 0; i < 20; ++i) {
    const Isometry3d X = pose(random, 3.0, 50.0);
    const MassProperties moved = massProperties(transformed(boxMesh(half), X), 1.0);
    const Matrix3d R = X.linear();
    EXPECT_LT((moved.center - X.translation()).norm(), 1e-12);
    EXPECT_LT((moved.inertia - R * exact.inertia * R.transpose()).norm(), 1e-10 * exact.inertia.norm());
  }
}

TEST(MassProperties, FarFromTheOriginNothingIsLost) {
  // Steps of 1/1024 m are exact at 10⁶ m.
  const Vector3d half(0.25, 0.125, 0.5), far(1e6, -1e6, 1e6);
  const MassProperties near = massProperties(boxMesh(half), 1.0);
  const MassProperties moved = massProperties(translated(boxMesh(half), far), 1.0);
  EXPECT_LT((moved.inertia - near.inertia).norm(), 1e-14 * near.inertia.norm());
  EXPECT_EQ(moved.center, far);
}

TEST(MassProperties, FineMeshesApproachCurvedPrimitives) {
  const MassProperties ball = massProperties(Primitive(Sphere{0.1}), 1000.0);
  EXPECT_NEAR(ball.inertia(1, 1), 0.4 * ball.mass * 0.01, 1e-15);
  const MassProperties ball_mesh = massProperties(tessellate(Primitive(Sphere{0.1}), 1e-6), 1000.0);
  EXPECT_NEAR(ball_mesh.mass, ball.mass, 1e-4 * ball.mass);
  EXPECT_LT((ball_mesh.inertia - ball.inertia).norm(), 2e-4 * ball.inertia.norm());
  const Primitive can = Cylinder::fromRadiusAndLength(0.05, 0.4);
  const MassProperties cylinder = massProperties(can, 1000.0);
  const MassProperties cylinder_mesh = massProperties(tessellate(can, 1e-6), 1000.0);
  EXPECT_LT((cylinder_mesh.inertia - cylinder.inertia).norm(), 2e-4 * cylinder.inertia.norm());
}

TEST(MassProperties, TorusHasItsClosedForm) {
  const double R = 0.2, r = 0.05;
  const MassProperties torus = massProperties(torusMesh(R, r, 400, 200), 1.0);
  const double mass = 2.0 * kPi * kPi * R * r * r;
  EXPECT_NEAR(torus.mass, mass, 1e-3 * mass);
  EXPECT_NEAR(torus.inertia(2, 2), torus.mass * (R * R + 0.75 * r * r), 1e-3 * torus.inertia(2, 2));
}

TEST(MassProperties, WithoutVolumeOrDensityItIsRefused) {
  TriangleMesh triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  EXPECT_THROW(massProperties(triangle, 1.0), std::invalid_argument);
  EXPECT_THROW(massProperties(flipped(boxMesh({1, 1, 1})), 1.0), std::invalid_argument);
  for (const double density : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")}) {
    EXPECT_THROW(massProperties(boxMesh({1, 1, 1}), density), std::invalid_argument) << density;
    EXPECT_THROW(massProperties(Primitive(Sphere{1.0}), density), std::invalid_argument) << density;
  }
  EXPECT_THROW(massProperties(Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), 1.0), std::invalid_argument);
}

TEST(MassProperties, ImpossibleInertiasAreRefused) {
  EXPECT_NO_THROW(validateInertia(1.0, Vector3d(1, 1, 2).asDiagonal()));  // a disc
  EXPECT_THROW(validateInertia(1.0, Vector3d(1, 1, 2.1).asDiagonal()), std::invalid_argument);
  EXPECT_THROW(validateInertia(1.0, Vector3d(1, 1, 0).asDiagonal()), std::invalid_argument);
  EXPECT_THROW(validateInertia(0.0, Matrix3d::Identity()), std::invalid_argument);
  Matrix3d skewed = Matrix3d::Identity();
  skewed(0, 1) = 0.1;
  EXPECT_THROW(validateInertia(1.0, skewed), std::invalid_argument);
}

}  // namespace sdf_ccd::mass_properties_test
