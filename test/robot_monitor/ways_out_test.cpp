#include "robot_monitor/ways_out.h"

#include <gtest/gtest.h>

#include <map>

namespace sdf_ccd::ways_out_test {

/// An arm of two links in a plane, with a gripper of two fingers, of which one follows the other.
const char* const kArm = R"(<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/><link name="left"/><link name="right"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="0.4 0 0"/><axis xyz="0 0 -1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="grip" type="prismatic"><parent link="lower"/><child link="left"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/></joint>
  <joint name="other" type="prismatic"><parent link="lower"/><child link="right"/><origin xyz="0.3 0 0"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/><mimic joint="grip"/></joint>
  </robot>)";

class WaysOutTest : public ::testing::Test {
 protected:
  /// The rates of the joints that move the first pair apart.
  std::map<std::string, double> rates(const std::vector<ClosePair>& pairs) const {
    const std::vector<Isometry3d> X_WL = robot_.forwardKinematics(at_);
    std::map<std::string, double> found;
    const auto pose = [&](int link) { return std::optional<Isometry3d>(X_WL[static_cast<std::size_t>(link)]); };
    const std::vector<std::vector<SeparatingJoint>> ways = waysOut(robot_, pairs, pose);
    for (const SeparatingJoint& joint : ways[0]) found[joint.joint] = joint.rate;
    return found;
  }

  /// Change of the distance of two points that move with their links, by a small step of the joint.
  double trueRate(const ClosePair& pair, const std::string& joint) const {
    constexpr double kStep = 1e-6;
    JointPositions moved = at_;
    moved[joint] += kStep;
    const std::vector<Isometry3d> X_now = robot_.forwardKinematics(at_), X_then = robot_.forwardKinematics(moved);
    const auto carried = [&](int link, const Vector3d& p_W) {
      return link < 0 ? p_W : Vector3d(X_then[link] * (X_now[link].inverse() * p_W));
    };
    const auto along = [&](const Vector3d& a, const Vector3d& b) { return (b - a).dot(pair.normal_W); };
    return (along(carried(pair.link_a, pair.p_A_W), carried(pair.link_b, pair.p_B_W)) - along(pair.p_A_W, pair.p_B_W)) /
           kStep;
  }

  const RobotModel robot_{kArm};
  const JointPositions at_{{"shoulder", 0.3}, {"elbow", 0.7}, {"grip", 0.01}};
};

TEST_F(WaysOutTest, RatesAreThoseOfTheDistance) {
  const ClosePair wall{robot_.find("left"), -1, {0.5, 0.2, 0.1}, {0.5, 0.21, 0.1}, Vector3d::UnitY()};
  const ClosePair links{robot_.find("left"),
                        robot_.find("upper"),
                        {0.5, 0.2, 0.1},
                        {0.3, 0.1, 0.1},
                        Vector3d(-2.0, -1.0, 0.0).normalized()};
  for (const ClosePair& pair : {wall, links}) {
    const std::map<std::string, double> found = rates({pair});
    EXPECT_GE(found.size(), 2u);
    for (const auto& [joint, rate] : found) EXPECT_NEAR(rate, trueRate(pair, joint), 1e-5) << joint;
  }
  EXPECT_EQ(rates({links}).count("shoulder"), 0u);  // it moves both
}

TEST_F(WaysOutTest, AFollowerCountsForItsLeader) {
  const ClosePair fingers{robot_.find("left"),
                          robot_.find("right"),
                          {0.6, 0.0, 0.1},
                          {0.6, -0.01, 0.1},
                          (robot_.forwardKinematics(at_)[robot_.find("lower")].linear() * -Vector3d::UnitY())};
  const std::map<std::string, double> found = rates({fingers});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found.at("grip"), 2.0, 1e-9);
  EXPECT_NEAR(trueRate(fingers, "grip"), 2.0, 1e-6);
}

TEST_F(WaysOutTest, AJointThatBringsAnotherPairCloserIsNoWayOut) {
  const int left = robot_.find("left");
  const ClosePair wall{left, -1, {0.5, 0.2, 0.1}, {0.5, 0.21, 0.1}, Vector3d::UnitY()};
  const ClosePair opposite{left, -1, {0.5, 0.2, 0.1}, {0.5, 0.19, 0.1}, -Vector3d::UnitY()};
  EXPECT_FALSE(rates({wall}).empty());
  EXPECT_TRUE(rates({wall, opposite}).empty());
}

TEST_F(WaysOutTest, WithoutADirectionOrPoseThereIsNone) {
  ClosePair pair{robot_.find("left"), -1, {0.5, 0.2, 0.1}, {0.5, 0.2, 0.1}, Vector3d::Zero()};
  EXPECT_TRUE(rates({pair}).empty());
  pair.normal_W = Vector3d::UnitY();
  const auto unknown = [](int) { return std::optional<Isometry3d>(); };
  EXPECT_TRUE(waysOut(robot_, {pair}, unknown)[0].empty());
}

}  // namespace sdf_ccd::ways_out_test
