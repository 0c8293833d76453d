#include "robot_monitor/contact_torques.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sdf_ccd::contact_torques_test {

/// A boom rotates about the world's z axis, and carries a slide along its x axis. The tool is held by the slide.
const char* const kArm = R"(<robot name="arm">
  <link name="base"/><link name="boom"/><link name="slide"/><link name="tool"/>
  <joint name="turn" type="continuous"><parent link="base"/><child link="boom"/><axis xyz="0 0 1"/></joint>
  <joint name="push" type="prismatic"><parent link="boom"/><child link="slide"/><axis xyz="1 0 0"/>
    <limit lower="-9" upper="9" effort="1" velocity="1"/></joint>
  <joint name="hold" type="fixed"><parent link="slide"/><child link="tool"/></joint>
  </robot>)";

Isometry3d boomAt(double angle) {
  return Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
}

/// The tool is 2 m along the boom, and its body 0.5 m farther; a wall that no link carries presses on it. The boom has
/// rotated by `angle` at the end of the motion.
class ContactTorquesTest : public ::testing::Test {
 protected:
  ContactTorquesTest() : torques_(RobotModel(kArm)) {
    Body body;
    body.X_frame_B = Eigen::Translation3d(0.5, 0.0, 0.0) * Isometry3d::Identity();
    scene_.bodies.push_back(body);
    scene_.bodies.push_back(Body());
    std::vector<int> links = {3, -1};  // without a pose of its own: its body's is used
    torques_.swapLinks(links);
    pair_.body_a = 0;
    pair_.body_b = 1;
    pair_.span = {0, 1};
  }

  static Isometry3d toolAt(double angle) { return boomAt(angle) * Eigen::Translation3d(2.0, 0.0, 0.0); }

  /// @param checked_until  angle of the boom where the pair's check ended.
  std::vector<double> torquesAt(double angle, double checked_until) {
    torques_.setPose(1, boomAt(angle));
    torques_.setPose(2, toolAt(angle));
    return torquesOf(checked_until);
  }

  std::vector<double> torquesOf(double checked_until) {
    CycleMotion motion;
    motion.times = {0.0, 1.0};
    motion.X_WB = {{toolAt(checked_until) * scene_.bodies[0].X_frame_B}, {Isometry3d::Identity()}};
    motion.X_WB[0].push_back(motion.X_WB[0].back());
    pair_.on_b_W = {-pair_.on_a_W.force, -pair_.on_a_W.torque};
    std::vector<double> torques;
    torques_.compute(scene_, motion, {pair_}, torques);
    return torques;
  }

  ContactTorques torques_;
  Scene scene_;
  PairResult pair_;
};

TEST_F(ContactTorquesTest, AForceActsOverItsLeverAndAMomentAsItIs) {
  ASSERT_EQ(torques_.joints(), (std::vector<std::string>{"turn", "push"}));
  pair_.on_a_W = {Vector3d(3.0, -4.0, 7.0), Vector3d(0.0, 0.0, 0.25)};
  const std::vector<double> found = torquesAt(0.0, 0.0);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0], 2.5 * -4.0 + 0.25, 1e-12);
  EXPECT_NEAR(found[1], 3.0, 1e-12);
}

TEST_F(ContactTorquesTest, WhatIsCheckedLateActsOnTheArmAsItWasThen) {
  const double then = 0.3, now = 1.1;
  std::vector<int> links = {2, -1};
  torques_.swapLinks(links);
  pair_.on_a_W = {boomAt(then) * Vector3d(3.0, -4.0, 0.0), Vector3d::Zero()};
  const std::vector<double> at_once = torquesAt(then, then);
  EXPECT_NEAR(at_once[0], -10.0, 1e-12);
  EXPECT_NEAR(at_once[1], 3.0, 1e-12);
  const std::vector<double> late = torquesAt(now, then);
  EXPECT_NEAR(late[0], -10.0, 1e-12);
  EXPECT_NEAR(late[1], 3.0, 1e-12);
}

TEST_F(ContactTorquesTest, AJointAboveALinkWithoutAKnownPoseHasNone) {
  pair_.on_a_W.force = Vector3d(3.0, -4.0, 0.0);
  torquesAt(0.0, 0.0);
  torques_.setPose(2, toolAt(0.0));  // the boom's pose of the last cycle does not count
  const std::vector<double> found = torquesOf(0.0);
  EXPECT_TRUE(std::isnan(found[0]));
  EXPECT_NEAR(found[1], 3.0, 1e-12);
}

TEST_F(ContactTorquesTest, ADelayedPairDoesNothing) {
  pair_.on_a_W.force = Vector3d(3.0, -4.0, 0.0);
  pair_.span = {1, 1};
  EXPECT_EQ(torquesAt(0.0, 0.0), (std::vector<double>{0.0, 0.0}));
}

}  // namespace sdf_ccd::contact_torques_test
