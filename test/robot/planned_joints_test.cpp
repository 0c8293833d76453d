#include "sdf_ccd/trajectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle/failure.h"
#include "oracle/random.h"
#include "robot/planned_motion.h"

namespace sdf_ccd::planned_joints_test {

const char* const kRobot = R"(<robot name='r'>
  <link name='base'/><link name='arm'/><link name='bracket'/><link name='hand'/><link name='finger'/><link name='cart'/>
  <link name='kite'/><link name='wheel'/>
  <joint name='elbow' type='revolute'><parent link='base'/><child link='arm'/><origin xyz='0 0 1' rpy='0.3 0 1'/>
    <axis xyz='0 0 2'/><limit lower='-6' upper='1' effort='1' velocity='1'/></joint>
  <joint name='mount' type='fixed'><parent link='arm'/><child link='bracket'/><origin xyz='0.5 0 0'/></joint>
  <joint name='grip' type='prismatic'><parent link='bracket'/><child link='hand'/>
    <axis xyz='0 3 4'/><limit lower='0.1' upper='0' effort='1' velocity='1'/></joint>
  <joint name='follow' type='prismatic'><parent link='bracket'/><child link='finger'/>
    <axis xyz='0 1 0'/><limit lower='-1' upper='0.05' effort='1' velocity='1'/>
    <mimic joint='grip' multiplier='-0.5' offset='0.02'/></joint>
  <joint name='roll' type='planar'><parent link='base'/><child link='cart'/><axis xyz='0 0 1'/></joint>
  <joint name='fly' type='floating'><parent link='cart'/><child link='kite'/><origin xyz='0 1 0'/></joint>
  <joint name='spin' type='continuous'><parent link='base'/><child link='wheel'/><axis xyz='0 1 0'/></joint>
</robot>)";

class PlannedJointsTest : public ::testing::Test {
 protected:
  PlannedJointsTest() {
    // The robot is at a random pose, as tf would report it.
    test::Random random(5);
    const JointPoses poses = {
        {"roll", Isometry3d(Eigen::Translation3d(1, 2, 0) * Eigen::AngleAxisd(0.4, Vector3d::UnitZ()))},
        {"fly", test::pose(random, 3.0, 2.0)}};
    X_RL_ = robot_.forwardKinematics({{"elbow", -5.0}, {"grip", 0.04}, {"spin", 0.7}}, poses);
    for (int link = 1; link < 8; ++link) {
      now_.X_PL[robot_.jointAbove(link).name] = X_RL_[robot_.parent(link)].inverse() * X_RL_[link];
    }
  }

  static RobotTrajectory plan(const JointPositions& from, const JointPositions& to, const JointPoses& poses = {}) {
    return {{0.0, 1.0}, {{Isometry3d::Identity(), from, poses}, {Isometry3d::Identity(), to, poses}}};
  }
  static RobotTrajectory at(const JointPositions& positions, const JointPoses& poses = {}) {
    return plan(positions, positions, poses);
  }

  PlannedJoints complete(const RobotTrajectory& named, const PlanRules& rules = {}) {
    return completePlan(robot_, named, now_, rules);
  }

  std::string refusal(const RobotTrajectory& named, const PlanRules& rules = {}) {
    return test::failureOf<std::invalid_argument>([&] { complete(named, rules); });
  }

  std::vector<Isometry3d> poses(const PlannedJoints& plan, std::size_t waypoint) const {
    const RobotState& state = plan.trajectory.states[waypoint];
    return robot_.forwardKinematics(state.positions, state.poses);
  }

  std::size_t indexOf(const std::string& link) const {
    const auto& links = robot_.links();
    return std::find(links.begin(), links.end(), link) - links.begin();
  }

  RobotModel robot_{kRobot};
  std::vector<Isometry3d> X_RL_;
  CurrentJoints now_;
};

TEST_F(PlannedJointsTest, WhatIsNotNamedRestsWhereItIs) {
  const PlannedJoints planned = complete(plan({{"spin", 0.0}}, {{"spin", 1.0}}));
  const std::vector<Isometry3d> X = poses(planned, 1);
  for (std::size_t link = 0; link < X.size(); ++link) {
    if (robot_.links()[link] == "wheel") continue;
    EXPECT_TRUE(X[link].isApprox(X_RL_[link], 1e-12)) << robot_.links()[link];
  }
  std::map<std::string, double> assumed;
  for (const AssumedJoint& joint : planned.assumed) assumed[joint.name] = joint.position;
  EXPECT_EQ(assumed.size(), 5u);
  EXPECT_NEAR(assumed.at("elbow"), -5.0, 1e-12);  // the one within its limits, of all that the pose allows
  EXPECT_NEAR(assumed.at("grip"), 0.04, 1e-12);
  EXPECT_NEAR(assumed.at("follow"), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(assumed.at("roll")));
  EXPECT_TRUE(std::isnan(assumed.at("fly")));
  EXPECT_TRUE(planned.beyond_limits.empty());
  for (const std::string& missing : planned.missing) EXPECT_EQ(missing, "");
}

TEST_F(PlannedJointsTest, WhatIsNotKnownIsMissingWithAllBelowIt) {
  now_.X_PL.erase("elbow");
  now_.X_PL.erase("mount");
  now_.missing["elbow"] = "no transform";
  const PlannedJoints planned = complete(at({{"spin", 0.0}}));
  const auto missing = [&](const std::string& link) { return planned.missing[indexOf(link)]; };
  EXPECT_EQ(missing("arm"), "joint elbow is not in the plan, and its current position is unknown: no transform");
  EXPECT_EQ(missing("finger"), missing("arm"));
  EXPECT_EQ(missing("kite"), "");
  EXPECT_EQ(complete(at({{"elbow", 0.0}})).missing[1], "");  // the fixed joint is at its pose in the URDF
}

TEST_F(PlannedJointsTest, AssumedPositionsBeyondLimitsAreSaid) {
  now_.X_PL["grip"] = Isometry3d(Eigen::Translation3d(0.0, 0.6 * 0.2, 0.8 * 0.2));
  const PlannedJoints planned = complete(at({{"spin", 0.0}}));
  ASSERT_EQ(planned.beyond_limits.size(), 1u);
  EXPECT_EQ(planned.beyond_limits[0], "joint grip: position 0.2 is beyond its limits [0, 0.1]");
}

TEST_F(PlannedJointsTest, MimicJointsFollowAndMayBeNamedBesideTheirLeader) {
  const PlannedJoints planned = complete(at({{"grip", 0.06}, {"follow", -0.01}}));
  EXPECT_TRUE(poses(planned, 0)[indexOf("finger")].isApprox(
      X_RL_[indexOf("bracket")] * Eigen::Translation3d(0.0, -0.01, 0.0), 1e-12));
  EXPECT_EQ(refusal(at({{"grip", 0.06}, {"follow", 0.01}})),
            "joint follow: cannot be at 0.01 (waypoint 0): grip has it at -0.01");
  EXPECT_EQ(refusal(at({{"follow", 0.01}})), "joint follow: follows grip, which is not named");
}

TEST_F(PlannedJointsTest, LimitsHoldUnlessTheyNeedNot) {
  EXPECT_EQ(refusal(plan({{"elbow", 0.0}}, {{"elbow", 1.1}})),
            "joint elbow: position 1.1 is beyond its limits [-6, 1] (waypoint 1)");
  EXPECT_EQ(refusal(at({{"elbow", 1.0 + 5e-7}})), "");
  EXPECT_EQ(refusal(at({{"grip", 0.11}})), "joint grip: position 0.11 is beyond its limits [0, 0.1] (waypoint 0)");
  EXPECT_EQ(refusal(at({{"grip", 0.05}})), "");  // its limits are in the wrong order
  EXPECT_EQ(refusal(at({{"spin", 99.0}})), "");
  EXPECT_EQ(refusal(plan({{"elbow", 0.0}}, {{"elbow", 1.1}}), {true}), "");
  EXPECT_NEAR(complete(at({{"elbow", 1.1}}), {true}).trajectory.states[1].positions.at("elbow"), 1.1, 1e-15);
}

TEST_F(PlannedJointsTest, FixedJointsStay) {
  EXPECT_EQ(refusal(at({{"mount", 0.0}})), "");
  EXPECT_EQ(refusal(plan({{"mount", 0.0}}, {{"mount", 0.1}})),
            "joint mount: is fixed, and cannot be at 0.1 (waypoint 1)");
  EXPECT_NE(refusal(at({}, {{"mount", Isometry3d::Identity()}})).find("joint mount: "), std::string::npos);
}

TEST_F(PlannedJointsTest, PosesAreForFloatingAndPlanarJoints) {
  Isometry3d X(Eigen::Translation3d(1.0, 2.0, 0.0));
  const PlannedJoints planned = complete(at({}, {{"roll", X}, {"fly", X}}));
  EXPECT_TRUE(poses(planned, 1)[indexOf("kite")].translation().isApprox(Vector3d(2.0, 5.0, 0.0), 1e-12));
  EXPECT_EQ(planned.assumed.size(), 4u);
  X.translation().z() = 0.01;
  EXPECT_EQ(refusal(at({}, {{"roll", X}})), "joint roll: is planar, and its pose outside the plane (waypoint 0)");
  EXPECT_EQ(refusal(at({}, {{"roll", Isometry3d(Eigen::AngleAxisd(0.01, Vector3d::UnitX()))}})),
            "joint roll: is planar, and its pose outside the plane (waypoint 0)");
  EXPECT_EQ(refusal(at({}, {{"elbow", X}})), "joint elbow: has one degree of freedom: give positions, not poses");
  EXPECT_EQ(refusal(at({{"roll", 0.5}})), "joint roll: has several degrees of freedom: give poses, not positions");
}

TEST_F(PlannedJointsTest, UnknownJointsAndNumbersThatAreNoneAreRefused) {
  EXPECT_NE(refusal(at({{"knee", 0.0}})).find("has no joint knee"), std::string::npos);
  EXPECT_NE(refusal(at({}, {{"knee", Isometry3d::Identity()}})).find("has no joint knee"), std::string::npos);
  EXPECT_NE(refusal(at({{"elbow", std::nan("")}})).find("is not finite"), std::string::npos);
}

}  // namespace sdf_ccd::planned_joints_test
