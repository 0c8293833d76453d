#include "sdf_ccd/monitor/monitor.h"

#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "oracle/scene_case.h"

namespace sdf_ccd {
namespace {

using namespace test;

TEST(NearestBody, FindsTheNearestAndItsGradient) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.05));
  // Only the ground's field is planned: the ball needs only a shell.
  const std::vector<Isometry3d> X_WB = {pose({0, 0, -1}, kPi / 2, {0, 1, 0}), Isometry3d::Identity()};
  const NearestBody nearest = nearestBody(*scene, X_WB, {0.7, 0.2, 0.3});
  EXPECT_EQ(nearest.body, 0);
  EXPECT_NEAR(nearest.distance, 0.7, 1e-12);
  EXPECT_LT((nearest.gradient_W - Vector3d::UnitX()).norm(), 1e-12);

  const auto two = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, fine(0.05));
  const NearestBody other = nearestBody(*two, {translation({0, 0, 0}), translation({1, 0, 0})}, {0.8, 0, 0});
  EXPECT_EQ(other.body, 1);
  EXPECT_NEAR(other.distance, 0.1, 1e-12);
  EXPECT_EQ(nearestBody(Scene{}, {}, {0, 0, 0}).body, -1);
}

/// A bin half a metre wide without a lid: its centre may be on either side.
TEST(NearestBody, ErrorHoldsForEitherSideOfAnOpenMesh) {
  const auto scene = build({body("ball", Primitive(Sphere{0.1})), body("bin", meshShape(binMesh(0.25)))}, fine(0.05));
  const std::vector<Isometry3d> X_WB = {translation({9, 0, 0}), Isometry3d::Identity()};
  const NearestBody middle = nearestBody(*scene, X_WB, {0, 0, -0.05});
  EXPECT_EQ(middle.body, 1);
  EXPECT_LE(middle.distance - middle.error, -0.2);
  EXPECT_GE(middle.distance + middle.error, 0.2);
  // Above the opening's centre, the nearest part of the mesh is its rim.
  const Vector3d above(0, 0, 0.3);
  const NearestBody over = nearestBody(*scene, X_WB, above);
  EXPECT_LE(over.distance - over.error, std::hypot(0.25, 0.05));
  EXPECT_GE(over.distance + over.error, std::hypot(0.25, 0.05));
  EXPECT_LT(nearestBody(*scene, X_WB, {0, 0, -0.3}).error, 0.02);
}

}  // namespace
}  // namespace sdf_ccd
