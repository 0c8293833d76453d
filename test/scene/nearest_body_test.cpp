#include "sdf_ccd/scene/monitor.h"

#include <gtest/gtest.h>

#include "scene/scene_case.h"

namespace sdf_ccd {
namespace {

using namespace test;

TEST(NearestBody, FindsTheNearestAndItsGradient) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.05));
  // Only the ground's field is planned: the ball is ever a shell.
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

}  // namespace
}  // namespace sdf_ccd
