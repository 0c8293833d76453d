#include "robot/joint_torques.h"

#include <gtest/gtest.h>

#include "oracle/random.h"

namespace sdf_ccd::joint_torques_test {

using test::Random;

/// Joints of all kinds: revolute, prismatic along an axis that is not unit, fixed, continuous, one that mimics the
/// first and one that mimics that; and another branch.
const char* const kRobot = R"(
<robot name='r'>
  <link name='base'/><link name='a'/><link name='b'/><link name='c'/><link name='d'/><link name='e'/><link name='f'/>
  <link name='g'/>
  <joint name='turn' type='revolute'><parent link='base'/><child link='a'/><origin xyz='0.1 0 0.3' rpy='0.2 0.1 0'/>
    <axis xyz='0 1 0.5'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>
  <joint name='slide' type='prismatic'><parent link='a'/><child link='b'/><origin xyz='0.2 0.1 0' rpy='0 0.4 0'/>
    <axis xyz='2 0 0'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>
  <joint name='fixed' type='fixed'><parent link='b'/><child link='c'/><origin xyz='0 0.1 0.2' rpy='0.5 0 0.3'/></joint>
  <joint name='spin' type='continuous'><parent link='c'/><child link='d'/><origin xyz='0.3 0 0'/>
    <axis xyz='0 0 1'/></joint>
  <joint name='mimic' type='revolute'><parent link='d'/><child link='e'/><origin xyz='0.1 0.1 0.1'/><axis xyz='1 0 0'/>
    <limit lower='-9' upper='9' effort='1' velocity='1'/><mimic joint='turn' multiplier='-2' offset='0.3'/></joint>
  <joint name='mimic2' type='prismatic'><parent link='e'/><child link='f'/><origin xyz='0.1 0 0'/><axis xyz='0 0 1'/>
    <limit lower='-9' upper='9' effort='1' velocity='1'/><mimic joint='mimic' multiplier='0.5'/></joint>
  <joint name='other' type='continuous'><parent link='base'/><child link='g'/><origin xyz='0 0.5 0'/>
    <axis xyz='1 0 0'/></joint>
</robot>)";

TEST(JointTorques, AreTheWorkOfTheWrenchesPerMotionOfTheJoint) {
  const RobotModel robot(kRobot);
  const JointTorques torques(robot);
  EXPECT_EQ(torques.joints(), (std::vector<std::string>{"other", "turn", "slide", "spin"}));
  Random random(3);
  for (int run = 0; run < 50; ++run) {
    JointPositions positions;
    for (const std::string& joint : torques.joints()) positions[joint] = test::uniform(random, -2.0, 2.0);
    const std::vector<Isometry3d> X_WL = robot.forwardKinematics(positions);
    // Forces at points of all links, as wrenches about the links' origins.
    std::vector<Wrench> wrenches;
    std::vector<Vector3d> points_L, forces;
    for (const Isometry3d& X : X_WL) {
      points_L.push_back(test::direction(random));
      forces.push_back(10.0 * test::direction(random));
      wrenches.push_back({forces.back(), (X.linear() * points_L.back()).cross(forces.back())});
    }
    std::vector<double> found;
    torques.compute(X_WL, wrenches, found);
    const auto work = [&](const JointPositions& at) {  // relative to the origin, with constant forces
      const std::vector<Isometry3d> X = robot.forwardKinematics(at);
      double sum = 0.0;
      for (std::size_t link = 0; link < X.size(); ++link) sum += forces[link].dot(X[link] * points_L[link]);
      return sum;
    };
    for (std::size_t i = 0; i < found.size(); ++i) {
      constexpr double kStep = 1e-5;
      JointPositions less = positions, more = positions;
      less[torques.joints()[i]] -= kStep;
      more[torques.joints()[i]] += kStep;
      EXPECT_NEAR(found[i], (work(more) - work(less)) / (2.0 * kStep), 1e-7) << torques.joints()[i];
    }
  }
}

TEST(JointTorques, WithoutWrenchesThereAreNone) {
  const RobotModel robot(kRobot);
  const JointTorques torques(robot);
  std::vector<double> found;
  torques.compute(robot.forwardKinematics({}), std::vector<Wrench>(robot.links().size()), found);
  EXPECT_EQ(found, std::vector<double>(4, 0.0));
}

}  // namespace sdf_ccd::joint_torques_test
