#include "ros/monitor/robot_in_map.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"
#include "ros/monitor/robot_in_map.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::robot_in_map_test {

using test::stampedTransform;

/// A hand that moves by 1 m/s along x, an arm at rest, and an object of the world.
class RobotInMapTest : public ::testing::Test {
 protected:
  RobotInMapTest() { history_.add(test::message({stampedTransform("world", "arm", 0.0, 3.0)}), true); }

  /// Sends the hand's transforms over a period [s].
  void sendHand(int from, int to) {
    for (int t = from; t <= to; ++t) history_.add(test::message({stampedTransform("world", "/hand", t, t)}), false);
  }
  static double xOf(const BodyInMap& body) { return body.X_BM.inverse().translation().x(); }

  SceneDescription description_{
      {test::body("hand", Sphere{0.1}), test::body("arm", Sphere{0.1}), test::body("table", Sphere{0.1}, true)}, {}};
  std::shared_ptr<const CheckedWorld> world_ = firstWorld(test::build(description_), description_);
  TfHistory history_{"world"};
};

TEST_F(RobotInMapTest, PosesAreThoseAtTheStamp) {
  sendHand(100, 105);
  RobotInMap robot(history_, "world", ros::Time(102.5), 1.5);
  robot.update(*world_);
  ASSERT_EQ(robot.bodies().size(), 2u);
  EXPECT_NEAR(xOf(robot.bodies()[0]), 102.5, 1e-9);
  EXPECT_NEAR(xOf(robot.bodies()[1]), 3.0, 1e-9);
  EXPECT_EQ(robot.problem(), "");
  EXPECT_EQ(robot.unknown(), 0u);
}

TEST_F(RobotInMapTest, NoPoseIsKnownInAGapOfTransforms) {
  sendHand(100, 102);
  sendHand(106, 107);
  for (const auto& [stamp, known] :
       {std::pair(101.5, true), {103.0, false}, {104.0, false}, {106.0, true}, {106.5, true}}) {
    RobotInMap robot(history_, "world", ros::Time(stamp), 1.5);
    robot.update(*world_);
    ASSERT_EQ(robot.bodies().size(), 2u);
    EXPECT_EQ(robot.bodies()[0].is_at_stamp, known) << stamp;
    EXPECT_EQ(robot.problem().rfind("hand has no transform for 4.000 s", 0) == 0, !known) << robot.problem();
    EXPECT_FALSE(robot.isAheadOfTf(10.0));
  }
}

TEST_F(RobotInMapTest, WhatWasAttachedLaterWasElsewhere) {
  sendHand(100, 105);
  ChangingObject hand;
  hand.link = "hand";
  hand.attached_since = std::chrono::seconds(103);
  const CheckedWorld world(world_->snapshot, {{"hand", hand}});
  for (const double stamp : {102.5, 103.5}) {
    RobotInMap robot(history_, "world", ros::Time(stamp), 1.5);
    robot.update(world);
    ASSERT_EQ(robot.bodies().size(), 2u);
    EXPECT_EQ(robot.bodies()[0].is_at_stamp, stamp > 103.0);
    EXPECT_TRUE(robot.bodies()[1].is_at_stamp);
    EXPECT_EQ(robot.unknown(), 0u) << "nothing will ever be known of where it was";
    EXPECT_EQ(robot.problem(), "");
  }
}

TEST_F(RobotInMapTest, WhereTfLagsThePresentPoseIsNotTakenForThatAtTheStamp) {
  sendHand(100, 102);
  RobotInMap robot(history_, "world", ros::Time(102.4), 1.5);
  robot.update(*world_);
  ASSERT_EQ(robot.bodies().size(), 2u);
  EXPECT_FALSE(robot.bodies()[0].is_at_stamp);
  EXPECT_NEAR(xOf(robot.bodies()[0]), 102.0, 1e-9);
  EXPECT_TRUE(robot.bodies()[1].is_at_stamp);
  EXPECT_TRUE(robot.isAheadOfTf(0.5));
  EXPECT_FALSE(robot.isAheadOfTf(0.3));
  EXPECT_EQ(robot.unknown(), 1u);
  EXPECT_EQ(robot.problem(), "hand is known from 100.000 s to 102.000 s, not at 102.400 s");
  const std::vector<VoxelMask> masks = robotMasks(world_->scene(), world_->description(), robot.bodies()).masks;
  ASSERT_EQ(masks.size(), 2u);
  EXPECT_TRUE(masks[0].only_unknown);
  EXPECT_FALSE(masks[1].only_unknown);

  sendHand(103, 103);
  robot.update(*world_);
  EXPECT_TRUE(robot.bodies()[0].is_at_stamp);
  EXPECT_NEAR(xOf(robot.bodies()[0]), 102.4, 1e-9);
  EXPECT_FALSE(robot.isAheadOfTf(0.5));
  EXPECT_EQ(robot.unknown(), 0u);
  sendHand(104, 130);  // tf has forgotten the time of the stamp
  robot.update(*world_);
  EXPECT_NEAR(xOf(robot.bodies()[0]), 102.4, 1e-9);
  EXPECT_EQ(robot.unknown(), 0u);
}

TEST_F(RobotInMapTest, OfAMapOlderThanTheTransformsOnlyRestingBodiesAreKnown) {
  sendHand(100, 105);
  for (const double stamp : {50.0, 0.0}) {
    RobotInMap robot(history_, "world", ros::Time(stamp), 1.5);
    robot.update(*world_);
    ASSERT_EQ(robot.bodies().size(), 2u);
    EXPECT_FALSE(robot.bodies()[0].is_at_stamp);
    EXPECT_TRUE(robot.bodies()[1].is_at_stamp);
    EXPECT_FALSE(robot.isAheadOfTf(1e3));
    EXPECT_EQ(robot.problem(),
              stamp == 0.0 ? "the map has no stamp" : "hand is known from 100.000 s to 105.000 s, not at 50.000 s");
  }
}

TEST_F(RobotInMapTest, BodiesWithoutTransformsAreUnknown) {
  RobotInMap robot(history_, "world", ros::Time(102.0), 1.5);
  robot.update(*world_);
  ASSERT_EQ(robot.bodies().size(), 1u);
  EXPECT_EQ(robot.unknown(), 2u);
  EXPECT_FALSE(robot.isAheadOfTf(1e3));
  sendHand(105, 105);
  robot.update(*world_);
  EXPECT_EQ(robot.unknown(), 1u);
}

TEST_F(RobotInMapTest, BothPosesAreOfTheSameTimeIfTheMapMoves) {
  sendHand(100, 105);
  for (int t = 100; t <= 103; ++t) history_.add(test::message({stampedTransform("world", "map", t, 2 * t)}), false);
  RobotInMap robot(history_, "map", ros::Time(104.0), 1.5);
  robot.update(*world_);
  EXPECT_FALSE(robot.bodies()[0].is_at_stamp);
  EXPECT_NEAR(xOf(robot.bodies()[0]), 105.0 - 206.0, 1e-9);
  EXPECT_FALSE(robot.bodies()[1].is_at_stamp);
}

}  // namespace sdf_ccd::robot_in_map_test
