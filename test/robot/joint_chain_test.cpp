#include "robot/joint_chain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/random.h"

namespace sdf_ccd::joint_chain_test {

/// A forearm, and behind it a wrist of two joints about z and a finger that slides along x.
const char* const kWrist = R"(<robot name="w">
  <link name="root"/><link name="forearm"/><link name="wrist"/><link name="flange"/><link name="finger"/><link name="free"/>
  <joint name="j0" type="revolute"><parent link="root"/><child link="forearm"/><origin xyz="0 0.3 0.2" rpy="0.4 0 0"/>
    <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="2"/></joint>
  <joint name="j1" type="revolute"><parent link="forearm"/><child link="wrist"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="0.5"/></joint>
  <joint name="j2" type="continuous"><parent link="wrist"/><child link="flange"/><axis xyz="0 0 2"/>
    <limit effort="1" velocity="0.25"/></joint>
  <joint name="slide" type="prismatic"><parent link="flange"/><child link="finger"/><origin xyz="0 0 0.05"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="0.1"/></joint>
  <joint name="loose" type="continuous"><parent link="wrist"/><child link="free"/><axis xyz="1 0 0"/></joint>
  </robot>)";

struct Wrist {
  RobotModel robot{kWrist};
  int link(const char* name) const { return robot.find(name); }
};

TEST(JointChain, JointsBetweenTwoLinksAreThoseThatMoveThemAgainstEachOther) {
  const Wrist w;
  EXPECT_EQ(jointsThatMove(w.robot, w.link("forearm"), w.link("forearm")), std::vector<int>());
  EXPECT_EQ(jointsThatMove(w.robot, w.link("forearm"), w.link("flange")),
            (std::vector<int>{w.link("flange"), w.link("wrist")}));
  EXPECT_EQ(jointsThatMove(w.robot, w.link("free"), w.link("flange")).size(), 2u);
  EXPECT_TRUE(isBelow(w.robot, w.link("finger"), w.link("wrist")));
  EXPECT_TRUE(isBelow(w.robot, w.link("wrist"), w.link("wrist")));
  EXPECT_FALSE(isBelow(w.robot, w.link("wrist"), w.link("finger")));
  EXPECT_FALSE(isBelow(w.robot, w.link("free"), w.link("flange")));
}

TEST(JointChain, ACommonAxisStaysWhereItIs) {
  const Wrist w;
  const std::vector<Isometry3d> X_RL = w.robot.forwardKinematics({});
  const std::optional<Axis> axis = commonAxis(w.robot, X_RL, w.link("forearm"), w.link("flange"));
  ASSERT_TRUE(axis);
  EXPECT_NEAR(axis->origin.head<2>().norm(), 0.0, 1e-12);
  EXPECT_NEAR(std::abs(axis->direction.z()), 1.0, 1e-12);
  EXPECT_FALSE(commonAxis(w.robot, X_RL, w.link("root"), w.link("flange")));
  EXPECT_FALSE(commonAxis(w.robot, X_RL, w.link("forearm"), w.link("finger")));  // it slides
  EXPECT_FALSE(commonAxis(w.robot, X_RL, w.link("wrist"), w.link("wrist")));
}

/// Balls of two links in random states: their true distance, by forward kinematics, does not fall faster than the
/// bound.
TEST(JointChain, NoDistanceFallsFasterThanTheJointsAllow) {
  const Wrist w;
  test::Random random(4);
  const BoundingBall ball_a{{0.01, 0.02, -0.03}, 0.02}, ball_b{{0.05, 0.0, 0.02}, 0.015};
  const std::map<std::string, double> limits = {{"j0", 2.0}, {"j1", 0.5}, {"j2", 0.25}, {"slide", 0.1}};
  double fastest = 0.0;
  const int root = w.link("root"), finger = w.link("finger");
  const double bound = maxClosingSpeed(w.robot, root, ball_a, finger, ball_b);
  for (int i = 0; i < 3000; ++i) {
    constexpr double kStep = 1e-5;
    JointPositions then, now;
    for (const auto& [joint, limit] : limits) {
      then[joint] = joint == "slide" ? test::uniform(random, 0.0, 0.04) : test::uniform(random, -3.0, 3.0);
      now[joint] = then[joint] + kStep * limit * (test::uniform(random, -1.0, 1.0) < 0.0 ? -1.0 : 1.0);
    }
    const auto distance = [&](const JointPositions& at) {
      const std::vector<Isometry3d> X_RL = w.robot.forwardKinematics(at);
      return (X_RL[root] * ball_a.center - X_RL[finger] * ball_b.center).norm() - ball_a.radius - ball_b.radius;
    };
    fastest = std::max(fastest, (distance(then) - distance(now)) / kStep);
  }
  EXPECT_LE(fastest, bound);
  EXPECT_GT(fastest, 0.2 * bound);
  EXPECT_TRUE(std::isinf(maxClosingSpeed(w.robot, w.link("free"), ball_a, finger, ball_b)));  // without a limit
  EXPECT_EQ(maxClosingSpeed(w.robot, finger, ball_a, finger, ball_b), 0.0);
}

}  // namespace sdf_ccd::joint_chain_test
