#include "robot_monitor/check_motion.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "robot/planned_motion.h"
#include "robot_monitor/check_motion_case.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd::check_motion_test {

using namespace test;

TEST_F(CheckMotionTest, TimesCountFromTheFirstPoint) {
  const std::shared_ptr<const Scene> scene = sceneOf({post("base", 2.0)});
  const auto motion = [&](std::size_t, double tolerance) { return motionOf(*scene, {0.0, 4.0}, tolerance, 5.0); };
  const PlannedMotion planned = motion(0, 1e-4);
  EXPECT_EQ(planned.samples, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(planned.waypoints.front(), 0.0);
  EXPECT_EQ(planned.waypoints.back(), 1.0);
  EXPECT_NEAR(checkMotion(scene, {}, planned).pairs[0].intervals.at(0).enter, 0.5, 0.02);
  EXPECT_LE(checkMotions(scene, {}, 1, motion).at(0).time, 0.51);
}

TEST_F(CheckMotionTest, FindsWhatLiesBetweenTheWaypoints) {
  // The rod's side touches the post when it still has asin((0.01 + 0.03) / 0.9) to rotate.
  const CycleResult result = turn(post("base", 2.0), {0.0, 4.0});
  EXPECT_EQ(result.verdict, Verdict::kContact);
  ASSERT_EQ(result.pairs.size(), 1u);
  ASSERT_EQ(result.pairs[0].intervals.size(), 1u);
  const double half_angle = std::asin(0.04 / 0.9);
  EXPECT_NEAR(result.pairs[0].intervals[0].enter, (2.0 - half_angle) / 4.0, 4e-3);
  EXPECT_NEAR(result.pairs[0].intervals[0].exit, (2.0 + half_angle) / 4.0, 4e-3);
  EXPECT_EQ(turn(post("base", 2.0), {0.0, 1.9}).verdict, Verdict::kClear);
}

TEST_F(CheckMotionTest, LongMotionsArePutTogetherOfPieces) {
  std::vector<double> angles;
  for (int i = 0; i <= 100; ++i) angles.push_back(0.05 * i);
  const CycleResult result = turn(post("base", 4.0), angles);
  EXPECT_EQ(result.verdict, Verdict::kContact);
  ASSERT_EQ(result.pairs[0].intervals.size(), 1u);
  EXPECT_NEAR(result.pairs[0].intervals[0].enter, (4.0 - std::asin(0.04 / 0.9)) / 0.05, 0.05);
}

TEST_F(CheckMotionTest, WhatALinkHoldsMovesWithIt) {
  BodyDescription wall = post("base", 1.5), tool = post("rod", 0.0);
  wall.name = "wall";
  wall.X_frame_B = wall.X_frame_B * Eigen::Translation3d(0.4, 0.0, 0.0);  // beyond the rod's end
  tool.X_frame_B = Eigen::Translation3d(1.3, 0.0, 0.0);
  tool.is_world = false;
  const CycleResult result = turn({wall, tool}, {1.0, 2.0});
  EXPECT_EQ(result.verdict, Verdict::kContact);
  const auto touching = std::find_if(result.pairs.begin(), result.pairs.end(),
                                     [](const PairResult& pair) { return pair.verdict == Verdict::kContact; });
  ASSERT_NE(touching, result.pairs.end());
  ASSERT_EQ(touching->intervals.size(), 1u);
  EXPECT_NEAR(touching->intervals[0].enter, 0.5 - 2.0 * std::asin(0.03 / 1.3), 4e-3);
  EXPECT_EQ(turn({wall, tool}, {1.0, 1.4}).verdict, Verdict::kClear);
}

TEST_F(CheckMotionTest, BodiesInUnknownFramesAreNotChecked) {
  const CycleResult result = turn(post("map", 2.0), {0.0, 1.0});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  ASSERT_EQ(result.pairs.size(), 1u);
  EXPECT_NE(result.pairs[0].reason.find("the robot has no link \"map\", the frame of post"), std::string::npos)
      << result.pairs[0].reason;
}

TEST(PlanThrough, KeepsWhatIsNotKnownOfTheMotion) {
  const auto scene =
      std::make_shared<const Scene>(makeScene({prepareBody("a", Box::fromSize({0.2, 0.2, 0.2}), {5e-3, {}}),
                                               prepareBody("b", Box::fromSize({0.2, 0.2, 0.2}), {5e-3, {}})}));
  const Isometry3d still = Isometry3d::Identity(), apart(Eigen::Translation3d(0.3, 0.0, 0.0));
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.X_WB = {{still, still}, {apart, apart}};
  const auto verdict = [&](const CycleMotion& motion) { return checkMotion(scene, {}, planThrough(motion)).verdict; };
  EXPECT_EQ(verdict(motion), Verdict::kClear);
  CycleMotion unsure = motion;
  unsure.motion_error = {0.2, 0.0};
  EXPECT_EQ(verdict(unsure), Verdict::kUncertain);
  CycleMotion lost = motion;
  lost.missing = {"gone", ""};
  lost.X_WB[0].clear();
  EXPECT_EQ(verdict(lost), Verdict::kNotChecked);
}

TEST(PlanThrough, RefusesWhatDoesNotFit) {
  const Isometry3d still = Isometry3d::Identity();
  CycleMotion good;
  good.times = {0.0, 1.0};
  good.X_WB = {{still, still}, {still, still}};
  EXPECT_NO_THROW(planThrough(good));
  const auto expectRefused = [](CycleMotion motion, const std::function<void(CycleMotion&)>& spoil) {
    spoil(motion);
    EXPECT_THROW(planThrough(motion), std::invalid_argument);
  };
  expectRefused(good, [](CycleMotion& motion) { motion.X_WB[1].push_back(motion.X_WB[1][0]); });
  expectRefused(good, [](CycleMotion& motion) { motion.times = {5.0, 6.0}; });
  expectRefused(good, [](CycleMotion& motion) { motion.times = {0.0}; });
  expectRefused(good, [](CycleMotion& motion) { motion.spans = {{0, 0}}; });
  expectRefused(good, [](CycleMotion& motion) { motion.missing = {"one"}; });
  expectRefused(good,
                [](CycleMotion& motion) { motion.X_WB[0][1] = Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitZ()); });
}

}  // namespace sdf_ccd::check_motion_test
