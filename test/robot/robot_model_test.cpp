#include "sdf_ccd/robot.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/files.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "robot/small_robots.h"

namespace sdf_ccd::robot_model_test {

using test::kArm;
using test::kPi;
using test::twoLinks;

// Names go into logs, and so to a terminal.
TEST(RobotModelTexts, NamesHoldNoControlCharacters) {
  const RobotModel robot("<robot name='&#27;c'><link name='&#27;[2Ja&#7;'/></robot>");
  EXPECT_EQ(robot.urdf().getName(), "?c");
  EXPECT_EQ(robot.root(), "?[2Ja?");
}

std::size_t indexOf(const RobotModel& robot, const std::string& link) {
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    if (robot.links()[i] == link) return i;
  }
  throw std::invalid_argument(link);
}

Isometry3d poseOf(const RobotModel& robot, const std::string& link, const JointPositions& positions) {
  return robot.forwardKinematics(positions)[indexOf(robot, link)];
}

TEST(RobotModel, ForwardKinematicsOfAnArm) {
  const RobotModel robot(kArm);
  const double s = 0.7, e = 0.9, d = 0.04;
  const JointPositions positions = {{"shoulder", s}, {"elbow", e}, {"slide", d}, {"spin", 0.5}};
  // Along the upper arm 0.5, then 0.3 + d rotated about y by e, all rotated about z by s.
  const double out = 0.5 + (0.3 + d) * std::cos(e);
  const Vector3d tip(out * std::cos(s), out * std::sin(s), 1.2 - (0.3 + d) * std::sin(e));
  EXPECT_TRUE(poseOf(robot, "tip", positions).translation().isApprox(tip, 1e-14));
  const Vector3d left(-std::sin(s), std::cos(s), 0);
  EXPECT_TRUE(poseOf(robot, "finger", positions).translation().isApprox(tip + (2 * d + 0.01) * left, 1e-14));
  const Isometry3d wheel = poseOf(robot, "wheel", positions);
  EXPECT_TRUE(wheel.translation().isApprox(Vector3d(0, 0.4, 0), 1e-14));
  EXPECT_TRUE(wheel.linear().col(0).isApprox(Vector3d(std::cos(0.5), 0, std::sin(0.5)), 1e-12));
  EXPECT_TRUE(wheel.linear().col(2).isApprox(Vector3d(0, -1, 0), 1e-12));
}

TEST(RobotModel, JointsThatAreNotNamedAreAtZeroOrTheNearestLimit) {
  const RobotModel robot(kArm);
  const Vector3d tip(0.5 + 0.3 * std::cos(0.1), 0, 1.2 - 0.3 * std::sin(0.1));
  EXPECT_TRUE(poseOf(robot, "tip", {}).translation().isApprox(tip, 1e-14));
}

/// As robot_state_publisher has it: a real gripper's fingers do not always move alike.
TEST(RobotModel, MimicJointFollowsItsLeaderUnlessItIsNamed) {
  const RobotModel robot(kArm);
  EXPECT_TRUE(poseOf(robot, "finger", {{"slide", 0.03}, {"grip", 0.07}})
                  .isApprox(poseOf(robot, "finger", {{"slide", 0.03}}), 1e-15));
  EXPECT_FALSE(poseOf(robot, "finger", {{"slide", 0.03}, {"grip", 0.05}})
                   .isApprox(poseOf(robot, "finger", {{"slide", 0.03}}), 1e-3));
}

TEST(RobotModel, RefusesUnknownJointsAndPositionsThatAreNotFinite) {
  const RobotModel robot(kArm);
  EXPECT_THROW(robot.forwardKinematics({{"knee", 0.0}}), std::invalid_argument);
  EXPECT_THROW(robot.forwardKinematics({{"elbow", std::nan("")}}), std::invalid_argument);
}

TEST(RobotModel, LinksAreInDepthFirstOrder) {
  const RobotModel robot(kArm);
  EXPECT_EQ(robot.root(), "base");
  EXPECT_EQ(robot.links().front(), "base");
  EXPECT_EQ(robot.links().size(), 7u);
  EXPECT_EQ(indexOf(robot, "tip"), indexOf(robot, "fore") + 1);
}

TEST(RobotModel, TellsRigidAndAdjacentLinks) {
  const RobotModel robot(kArm);
  EXPECT_TRUE(robot.rigidlyJoined("upper", "bracket"));
  EXPECT_TRUE(robot.rigidlyJoined("tip", "tip"));
  EXPECT_FALSE(robot.rigidlyJoined("base", "upper"));
  EXPECT_TRUE(robot.adjacent("base", "upper"));
  EXPECT_FALSE(robot.adjacent("base", "bracket"));  // one joint and a fixed one
  EXPECT_TRUE(robot.adjacent("fore", "bracket"));
  EXPECT_FALSE(robot.adjacent("fore", "upper"));
  EXPECT_FALSE(robot.adjacent("upper", "bracket"));
  EXPECT_FALSE(robot.adjacent("wheel", "upper"));
  EXPECT_THROW(robot.adjacent("wheel", "leg"), std::invalid_argument);
}

TEST(RobotModel, NeighboursHaveNoShapeBetweenThem) {
  const auto robot = [](const std::string& shape) {
    return RobotModel("<robot name='scara'><link name='post'/><link name='world'/><link name='base'>" + shape +
                      "</link><link name='arm'/>"
                      "<joint name='a' type='fixed'><parent link='world'/><child link='base'/></joint>"
                      "<joint name='b' type='fixed'><parent link='world'/><child link='post'/></joint>"
                      "<joint name='c' type='continuous'><parent link='base'/><child link='arm'/></joint></robot>");
  };
  EXPECT_TRUE(robot("").neighbours("arm", "post"));
  EXPECT_TRUE(robot("").neighbours("post", "base"));
  EXPECT_FALSE(robot("").adjacent("arm", "post")) << "they may be far apart, and the arm may reach the post";
  for (const std::string radius : {"0.1", "unreadable"}) {
    const RobotModel with_shape =
        robot("<collision><geometry><sphere radius='" + radius + "'/></geometry></collision>");
    EXPECT_FALSE(with_shape.neighbours("arm", "post")) << radius;
    EXPECT_FALSE(with_shape.neighbours("post", "arm")) << radius;
    EXPECT_TRUE(with_shape.neighbours("post", "base")) << radius;
    EXPECT_TRUE(with_shape.adjacent("arm", "base")) << radius;
    EXPECT_FALSE(with_shape.adjacent("world", "arm")) << radius;
  }
}

TEST(RobotModel, NothingIsAdjacentAcrossAJointThatHoldsNothing) {
  for (const std::string type : {"floating", "planar"}) {
    const RobotModel robot(
        twoLinks("<joint name='free' type='" + type + "'><parent link='a'/><child link='b'/></joint>"));
    EXPECT_FALSE(robot.adjacent("a", "b")) << type;
    EXPECT_FALSE(robot.rigidlyJoined("a", "b")) << type;
  }
}

TEST(RobotModel, LimitsInTheWrongOrderAreExchangedAndTold) {
  const auto hinge = [](const std::string& limits) {
    return RobotModel(twoLinks("<joint name='hinge' type='revolute'><parent link='a'/><child link='b'/><limit " +
                               limits + " effort='1' velocity='1'/></joint>"));
  };
  const RobotModel swapped = hinge("lower='1.5' upper='-0.5'");
  ASSERT_EQ(swapped.warnings().size(), 1u);
  EXPECT_EQ(swapped.warnings()[0], "joint hinge: its lower limit 1.5 is above its upper one -0.5; they are swapped");
  const urdf::Joint& joint = swapped.jointAbove(1);
  EXPECT_EQ(joint.limits->lower, -0.5);
  EXPECT_EQ(joint.limits->upper, 1.5);
  EXPECT_EQ(swapped.position(joint, {}), 0.0);
  EXPECT_TRUE(hinge("lower='-0.5' upper='1.5'").warnings().empty());
}

TEST(RobotModel, ReachIsExactOverOneJoint) {
  const RobotModel robot(kArm);
  const Vector3d origin = Vector3d::Zero();
  EXPECT_DOUBLE_EQ(robot.reach("upper", origin, "bracket", origin), 0.5);
  // The fore arm's origin rotates about z at a radius of 0.5, 1.2 above the base.
  EXPECT_NEAR(robot.reach("base", Vector3d(2, 0, 0), "fore", origin), std::hypot(2.5, 1.2), 1e-14);
  // With a tenth of the range beyond the limits.
  EXPECT_NEAR(robot.reach("fore", Vector3d(0.28, 0.1, 0), "tip", origin), std::hypot(0.12 + 0.015, 0.1), 1e-14);
}

double reachOf(const RobotModel& robot, const std::string& a, const std::string& b) {
  return robot.reach(a, Vector3d::Zero(), b, Vector3d::Zero());
}

std::string slider(const std::string& rest) {
  return twoLinks("<joint name='j' type='prismatic'><parent link='a'/><child link='b'/>" + rest + "</joint>");
}
std::string limits(const std::string& lower, const std::string& upper) {
  return "<limit lower='" + lower + "' upper='" + upper + "' effort='1' velocity='1'/>";
}

TEST(RobotModel, ReachHasAMarginBeyondLimits) {
  const auto farthest = [](const std::string& rest) { return reachOf(RobotModel(slider(rest)), "a", "b"); };
  EXPECT_NEAR(farthest("<axis xyz='1 0 0'/>" + limits("0", "2")), 2.2, 1e-14);
  EXPECT_NEAR(farthest("<axis xyz='0 3 4'/>" + limits("0", "2")), 2.2, 1e-14);  // an axis of length 5
  EXPECT_NEAR(farthest("<axis xyz='1 0 0'/>" + limits("2", "0")), 2.2, 1e-14);
  EXPECT_NEAR(farthest("<axis xyz='1 0 0'/>" + limits("0", "0.04")), 0.05, 1e-14);
  EXPECT_TRUE(std::isinf(farthest("<axis xyz='1 0 0'/><limit effort='1' velocity='1'/>")));
  EXPECT_TRUE(std::isinf(farthest("<axis xyz='1 0 0'/>" + limits("-1e308", "1e308"))));
}

TEST(RobotModel, PositionAtAPose) {
  const RobotModel robot(kArm);
  const JointPositions positions = {{"shoulder", 2.9}, {"elbow", 1.3}, {"slide", 0.07}, {"spin", -3.0}};
  const auto X = robot.forwardKinematics(positions);
  for (std::size_t link = 1; link < X.size(); ++link) {
    const urdf::Joint& joint = robot.jointAbove(link);
    if (joint.type == urdf::Joint::FIXED) continue;
    EXPECT_NEAR(robot.positionAt(joint, X[robot.parent(link)].inverse() * X[link]), robot.position(joint, positions),
                1e-12);
  }
}

TEST(RobotModel, ReachOfUnlimitedJointsIsInfinite) {
  for (const char* joint : {"<joint name='j' type='floating'><parent link='a'/><child link='b'/></joint>",
                            "<joint name='j' type='planar'><parent link='a'/><child link='b'/></joint>"}) {
    const RobotModel robot(twoLinks(joint));
    EXPECT_TRUE(std::isinf(reachOf(robot, "b", "a")));
    EXPECT_TRUE(poseOf(robot, "b", {}).isApprox(Isometry3d::Identity()));
  }
}

/// Random joint positions: any for revolute joints, within limits and margin for prismatic ones.
JointPositions randomPositions(const RobotModel& robot, test::Random& random) {
  JointPositions positions;
  for (const auto& [name, joint] : robot.urdf().joints_) {
    if (joint->type == urdf::Joint::PRISMATIC) {
      const double lower = joint->limits->lower, upper = joint->limits->upper;
      const double margin = std::max(0.01, 0.1 * (upper - lower));
      positions[name] = test::uniform(random, lower - margin, upper + margin);
    } else if (joint->type != urdf::Joint::FIXED) {
      positions[name] = test::uniform(random, -kPi, kPi);
    }
  }
  return positions;
}

void expectReachHolds(const RobotModel& robot, int states) {
  test::Random random(7);
  const std::size_t count = robot.links().size();
  std::vector<std::vector<double>> reach(count);
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(0.2 * test::direction(random));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      reach[i].push_back(robot.reach(robot.links()[i], points[i], robot.links()[j], points[j]));
    }
  }
  for (int state = 0; state < states; ++state) {
    const auto X = robot.forwardKinematics(randomPositions(robot, random));
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t j = 0; j < count; ++j) {
        const double distance = (X[i] * points[i] - X[j] * points[j]).norm();
        ASSERT_LE(distance, reach[i][j] + 1e-9) << robot.links()[i] << " " << robot.links()[j];
      }
    }
  }
}

TEST(RobotModel, ReachIsNeverViolated) {
  expectReachHolds(RobotModel(kArm), 3000);
}

TEST(RobotModel, ReachIsNeverViolatedByPanda) {
  SDF_CCD_NEEDS_DATA("robots/panda_from_xacro.urdf");
  expectReachHolds(RobotModel(test::readText(test::dataPath("robots/panda_from_xacro.urdf"))), 300);
}

TEST(RobotModel, ReachIsNeverViolatedByCalibratedPr2) {
  SDF_CCD_NEEDS_DATA("robots/pr2_calibrated/pr1012_urdf_67b1b5a5.urdf");
  const RobotModel robot(test::readText(test::dataPath("robots/pr2_calibrated/pr1012_urdf_67b1b5a5.urdf")));
  EXPECT_EQ(robot.links().size(), robot.urdf().links_.size());
  expectReachHolds(robot, 20);
}

}  // namespace sdf_ccd::robot_model_test
