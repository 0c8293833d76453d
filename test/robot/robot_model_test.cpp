#include "sdf_ccd/robot/robot_model.h"

#include <cmath>
#include <stdexcept>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/random.h"
#include "oracle/test_data.h"

namespace sdf_ccd {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// base –(shoulder, z)– upper –(fixed)– bracket –(elbow, y)– fore –(slide, x)– tip, and a finger that
/// mimics slide.
const char* const kArm = R"(<?xml version="1.0"?>
<!-- a comment -- with dashes, as calibrated robots have -->
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="bracket"/><link name="fore"/><link name="tip"/>
  <link name="finger"/><link name="wheel"/>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/>
    <origin xyz="0 0 1"/><axis xyz="0 0 2"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="mount" type="fixed"><parent link="upper"/><child link="bracket"/><origin xyz="0.5 0 0"/></joint>
  <joint name="elbow" type="revolute"><parent link="bracket"/><child link="fore"/>
    <origin xyz="0 0 0.2"/><axis xyz="0 1 0"/><limit lower="0.1" upper="2" effort="1" velocity="1"/></joint>
  <joint name="slide" type="prismatic"><parent link="fore"/><child link="tip"/>
    <origin xyz="0.3 0 0"/><axis xyz="1 0 0"/><limit lower="-0.05" upper="0.1" effort="1" velocity="1"/></joint>
  <joint name="grip" type="prismatic"><parent link="tip"/><child link="finger"/>
    <axis xyz="0 1 0"/><limit lower="0" upper="0.2" effort="1" velocity="1"/>
    <mimic joint="slide" multiplier="2" offset="0.01"/></joint>
  <joint name="spin" type="continuous"><parent link="base"/><child link="wheel"/>
    <origin xyz="0 0.4 0" rpy="1.5707963267948966 0 0"/><axis xyz="0 0 1"/></joint>
</robot>)";

std::size_t indexOf(const RobotModel& robot, const std::string& link) {
  for (std::size_t i = 0; i < robot.links().size(); ++i) {
    if (robot.links()[i] == link) return i;
  }
  throw std::invalid_argument(link);
}

Isometry3d poseOf(const RobotModel& robot, const std::string& link, const JointPositions& positions) {
  return robot.forwardKinematics(positions)[indexOf(robot, link)];
}

std::string failure(const std::string& xml, const std::string& source = {}) {
  return test::failureOf([&] { RobotModel(xml, source); });
}

std::string twoLinks(const std::string& joint) {
  return "<robot name='r'><link name='a'/><link name='b'/>" + joint + "</robot>";
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
  const auto still = robot.reach("upper", "bracket");
  EXPECT_DOUBLE_EQ(still.nearest, 0.5);
  EXPECT_DOUBLE_EQ(still.farthest, 0.5);
  // The fore arm's origin rotates about z at a radius of 0.5, 1.2 above the base.
  const auto turned = robot.reach("base", Vector3d(2, 0, 0), "fore", Vector3d::Zero());
  EXPECT_NEAR(turned.nearest, std::hypot(1.5, 1.2), 1e-14);
  EXPECT_NEAR(turned.farthest, std::hypot(2.5, 1.2), 1e-14);
  const auto slid = robot.reach("fore", Vector3d(0.28, 0.1, 0), "tip", Vector3d::Zero());
  EXPECT_NEAR(slid.nearest, 0.1, 1e-14);
  EXPECT_NEAR(slid.farthest, std::hypot(0.12 + 0.015, 0.1), 1e-14);  // with a tenth of the range beyond its limits
}

std::string slider(const std::string& rest) {
  return twoLinks("<joint name='j' type='prismatic'><parent link='a'/><child link='b'/>" + rest + "</joint>");
}
std::string limits(const std::string& lower, const std::string& upper) {
  return "<limit lower='" + lower + "' upper='" + upper + "' effort='1' velocity='1'/>";
}

TEST(RobotModel, ReachHasAMarginBeyondLimits) {
  const auto farthest = [](const std::string& rest) { return RobotModel(slider(rest)).reach("a", "b").farthest; };
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
    EXPECT_EQ(robot.reach("a", "b").nearest, 0.0);
    EXPECT_TRUE(std::isinf(robot.reach("b", "a").farthest));
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
  std::vector<std::vector<RobotModel::Reach>> reach(count);
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
        ASSERT_GE(distance, reach[i][j].nearest - 1e-9) << robot.links()[i] << " " << robot.links()[j];
        ASSERT_LE(distance, reach[i][j].farthest + 1e-9) << robot.links()[i] << " " << robot.links()[j];
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

TEST(RobotModel, ParserFailuresGiveTheReason) {
  ::testing::internal::CaptureStderr();
  EXPECT_NE(failure("").find("cannot be parsed"), std::string::npos);
  EXPECT_NE(failure("<robot name='r'><link").find("cannot be parsed"), std::string::npos);
  EXPECT_NE(failure("<sdf/>").find("robot"), std::string::npos);
  EXPECT_NE(failure("<robot name='r'><link name='twin'/><link name='twin'/></robot>").find("twin"), std::string::npos);
  EXPECT_NE(failure("<robot name='r'><link name='a'/><link name='b'/></robot>").find("root"), std::string::npos);
  EXPECT_NE(failure(twoLinks("<joint name='j' type='bendy'><parent link='a'/><child link='b'/></joint>")).find("bendy"),
            std::string::npos);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(failure("<robot name='r'><link", "arm.urdf").find("arm.urdf: the URDF cannot be parsed: "), 0U);
}

TEST(RobotModel, JointsWithoutKinematicsAreRefused) {
  const auto joint = [](const std::string& rest) {
    return twoLinks("<joint name='j' type='continuous'><parent link='a'/><child link='b'/>" + rest + "</joint>");
  };
  EXPECT_NE(failure(joint("<axis xyz='0 0 0'/>")).find("axis is 0 0 0"), std::string::npos);
  EXPECT_NE(failure(joint("<mimic joint='k'/>")).find("mimics k, which does not exist"), std::string::npos);
  EXPECT_NE(failure(joint("<mimic joint='j'/>")).find("mimics itself"), std::string::npos);
}

/// Each position is computed along the whole chain: thousands would take seconds a state.
TEST(RobotModel, LongChainsOfMimicJointsAreRefused) {
  const auto chain = [](int length) {
    std::string urdf = "<robot name='r'><link name='l0'/>";
    for (int i = 1; i <= length; ++i) {
      const std::string number = std::to_string(i), before = std::to_string(i - 1);
      urdf += "<link name='l" + number + "'/><joint name='j" + number + "' type='continuous'><parent link='l" + before +
              "'/><child link='l" + number + "'/>" + (i > 1 ? "<mimic joint='j" + before + "'/>" : "") + "</joint>";
    }
    return urdf + "</robot>";
  };
  EXPECT_NO_THROW(RobotModel(chain(100)));
  EXPECT_NE(failure(chain(102)).find("mimics a joint that mimics another, and so on, more than 100 times"),
            std::string::npos);
}

TEST(RobotModel, JointsThatAreNoTreeAreRefused) {
  const auto joint = [](const std::string& name, const std::string& parent, const std::string& child) {
    return "<joint name='" + name + "' type='fixed'><parent link='" + parent + "'/><child link='" + child +
           "'/></joint>";
  };
  const auto refusal = [](const std::string& content) { return failure("<robot name='r'>" + content + "</robot>"); };
  const std::string links = "<link name='a'/><link name='b'/><link name='c'/>";
  // urdfdom takes c for the root and drops the other links.
  EXPECT_EQ(refusal(links + joint("there", "a", "b") + joint("back", "b", "a")),
            "no chain of joints leads from the root link c to link a: it is in a loop, or below one");
  EXPECT_EQ(refusal(links + joint("to_b", "a", "b") + joint("to_c", "a", "c") + joint("closing", "b", "c")),
            "link c is the child of two joints, closing and to_c");
  // 2^40 paths lead to the last link.
  std::string ladder = "<link name='l0'/>";
  for (int i = 1; i <= 40; ++i) {
    const std::string from = "l" + std::to_string(i - 1), to = "l" + std::to_string(i);
    ladder += "<link name='" + to + "'/>" + joint("p" + to, from, to) + joint("q" + to, from, to);
  }
  EXPECT_NE(refusal(ladder).find(" is the child of two joints, "), std::string::npos);
}

TEST(RobotModel, TextThatIsCutShortOrBrokenIsRefused) {
  const std::string urdf = kArm;
  for (std::size_t size = 0; size < urdf.size() - 20; ++size) EXPECT_NE(failure(urdf.substr(0, size)), "") << size;
  // Bytes that begin a multi-byte character, at the end and elsewhere: urdfdom's reader read past the end for them.
  for (const char byte : {'\xC3', '\xEF', '\xF4', '\xB5', '\0'}) {
    for (std::size_t size = 0; size < urdf.size() - 20; size += 13) {
      EXPECT_NE(failure(urdf.substr(0, size) + byte), "") << size;
      std::string broken = urdf;
      broken[size] = byte;
      failure(broken);
    }
  }
  EXPECT_NE(failure(test::readText(SDF_CCD_SOURCE_DIR "/test/data/hostile/urdf_tinyxml_overread_130f7.urdf")), "");
}

TEST(RobotModel, CommentsMayHoldOtherEncodings) {
  EXPECT_EQ(failure("<!-- caf\xE9 --><robot name=\"r\"><link name=\"a\"/></robot>"), "");
}

TEST(RobotModel, DeepAndLargeTextsAreRefused) {
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  EXPECT_NE(failure(deep), "");
  std::string many = "<robot name=\"r\">";
  for (int i = 0; i < 20'000; ++i) {
    const std::string link = "l" + std::to_string(i), next = "l" + std::to_string(i + 1);
    many += "<link name=\"" + link + "\"/><joint name=\"j" + link + "\" type=\"fixed\"><parent link=\"" + link +
            "\"/><child link=\"" + next + "\"/></joint>";
  }
  many += "<link name=\"l20000\"/></robot>";
  EXPECT_NE(failure(many).find("more than 10000"), std::string::npos) << failure(many);
  EXPECT_NE(failure("<robot>" + std::string(std::size_t{65} << 20, ' ')).find("larger than 64 MiB"), std::string::npos);
}

TEST(RobotModel, MacrosThatWereNotExpandedAreNamed) {
  const auto robot = [](const std::string& inside) {
    return "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>\n" + inside + "\n<link name='a'/></robot>";
  };
  const auto warnings = [&](const std::string& inside) { return RobotModel(robot(inside)).warnings(); };
  EXPECT_EQ(
      warnings("<xacro:arm prefix='l_'/>"),
      std::vector<std::string>{"the URDF's line 2: <xacro:arm> is ignored: xacro has not expanded it, and what it "
                               "stands for is missing"});
  const std::vector<std::string> two = warnings("<gazebo><xacro:sensor/></gazebo>\n<xacro:include filename='b'/>");
  ASSERT_EQ(two.size(), 1u);
  EXPECT_NE(two[0].find("> is ignored with 1 other"), std::string::npos) << two[0];
  EXPECT_EQ(
      warnings("<link name='${prefix}b'/><joint name='j' type='fixed'><parent link='a'/><child link='${prefix}b'/>"
               "</joint>"),
      std::vector<std::string>{"the URDF's line 2: name=\"${prefix}b\" is taken as it is with 1 other: xacro has not "
                               "expanded it, and what it stands for is missing"});
  EXPECT_TRUE(warnings("<xacro:property name='x' value='1'/><xacro:macro name='arm' params=''><xacro:leg/>"
                       "</xacro:macro>")
                  .empty());
}

TEST(RobotModel, ElementsThatTheParserPassesOverAreNamed) {
  const auto warnings = [](const std::string& of_joint, const std::string& of_robot) {
    return RobotModel(
               "<robot name='r'><link name='a'/><link name='b'/>\n<joint name='j' type='fixed'>"
               "<parent link='a'/><child link='b'/>" +
               of_joint + "</joint>\n" + of_robot + "</robot>")
        .warnings();
  };
  EXPECT_TRUE(warnings("<origin xyz='1 0 0'/><limit effort='1' velocity='1'/>",
                       "<transmission><joint name='j'><limit/></joint></transmission><gazebo><Link/></gazebo>")
                  .empty());
  EXPECT_EQ(warnings("<Origin xyz='1 0 0'/>", ""),
            std::vector<std::string>{"joint j: line 2 of the URDF: <Origin> is ignored: it must be <origin>"});
  EXPECT_EQ(warnings("<origin xyz='1 0 0'/><origin xyz='2 0 0'/>", ""),
            std::vector<std::string>{"joint j: line 2 of the URDF: <origin> is ignored: its <joint> has one already"});
  EXPECT_EQ(warnings("<pose>1 0 0 0 0 0</pose>", ""),
            std::vector<std::string>{"joint j: line 2 of the URDF: <pose> in <joint> is ignored: it must be <origin "
                                     "xyz=\"...\" rpy=\"...\">"});
  EXPECT_EQ(warnings("<origin position='1 0 0' rpy='0 0 0' name='j'/>", ""),
            std::vector<std::string>{"joint j: line 2 of the URDF: <origin> has position=\"1 0 0\", which is ignored: "
                                     "its attributes are xyz and rpy"});
  EXPECT_TRUE(warnings("<origin xyz='1 0 0' name='j'/>", "").empty());
  EXPECT_EQ(warnings("", "<Link name='c'/><axis/>"),
            (std::vector<std::string>{"line 3 of the URDF: <Link> is ignored: it must be <link>",
                                      "line 3 of the URDF: <axis> in <robot> is ignored: it belongs in <joint>"}));
}

TEST(RobotModel, LinksAndJointsThatTheParserDoesNotFindAreNamed) {
  const auto warnings = [](const std::string& inside, const std::string& behind = "") {
    return RobotModel("<robot name='r'><link name='a'/>\n" + inside + "</robot>\n" + behind).warnings();
  };
  const std::string link = "<link name='c'><visual/></link>";
  const std::string joint = "<joint name='k' type='fixed'><parent link='a'/><child link='c'/></joint>";
  EXPECT_EQ(warnings("<group>" + link + "<part>" + joint + "</part></group>"),
            (std::vector<std::string>{"link c: line 2 of the URDF: <link> in <group> is ignored: it belongs in <robot>",
                                      "joint k: line 2 of the URDF: <joint> in <part> is ignored: it belongs in "
                                      "<robot>"}));
  EXPECT_EQ(
      warnings("<links><Link name='c'><inertial/></Link></links>"),
      std::vector<std::string>{"link c: line 2 of the URDF: <Link> in <links> is ignored: it belongs in <robot>"});
  const std::string second = " is ignored: the URDF has one already";
  EXPECT_EQ(warnings("<robot name='s'>" + link + "</robot>"),
            std::vector<std::string>{"line 2 of the URDF: <robot>" + second});
  EXPECT_EQ(warnings("<tools><robot name='s'>" + link + "</robot></tools>"),
            std::vector<std::string>{"line 2 of the URDF: <robot>" + second});
  EXPECT_EQ(warnings("", "<robot name='s'>" + link + "</robot>"),
            std::vector<std::string>{"line 3 of the URDF: <robot>" + second});
  // Other formats' elements of these names.
  EXPECT_TRUE(warnings("<gazebo><model><link name='c'><visual/></link></model></gazebo><group name='arm'>"
                       "<link name='a'/><joint name='j'/></group><ros2_control><joint name='j'><param/></joint>"
                       "</ros2_control><plugin><robot>r</robot></plugin>",
                       "<about/>")
                  .empty());
  EXPECT_TRUE(warnings("<xacro:macro name='m' params=''>" + link + "</xacro:macro>").empty());
}

/// Nobody reads what stands in a joint.
TEST(RobotModel, ShapesAndLinksInJointsAreNamed) {
  const auto warnings = [](const std::string& in_joint, const std::string& in_child) {
    return RobotModel(
               "<robot name='r'><link name='a'/><link name='b'/><joint name='j' type='fixed'><parent link='a'/>\n" +
               in_joint + "<child link='b'>" + in_child + "</child></joint></robot>")
        .warnings();
  };
  const std::string shape = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
  const std::string link = "<link name='c'>" + shape + "</link>";
  EXPECT_TRUE(warnings("", "").empty());
  EXPECT_EQ(warnings(shape, ""),
            std::vector<std::string>{"joint j: line 2 of the URDF: <collision> in <joint> is ignored: "
                                     "it belongs in <link>"});
  EXPECT_EQ(
      warnings("<axis xyz='1 0 0'>" + shape + "</axis>", ""),
      std::vector<std::string>{"joint j: line 2 of the URDF: <collision> in <axis> is ignored: it belongs in <link>"});
  EXPECT_EQ(warnings(link, ""), std::vector<std::string>{
                                    "link c: line 2 of the URDF: <link> in <joint> is ignored: it belongs in <robot>"});
  EXPECT_EQ(warnings("", "<x>" + link + "</x>"),
            std::vector<std::string>{"link c: line 2 of the URDF: <link> in <x> is ignored: it belongs in <robot>"});
}

TEST(RobotModel, TheRobotNeedNotBeTheFirstElement) {
  const RobotModel robot(
      "<about><link name='c'><visual/></link></about>\n<robot name='r'><link name='a'/><axis/></robot>");
  EXPECT_EQ(robot.warnings(),
            std::vector<std::string>{"line 2 of the URDF: <axis> in <robot> is ignored: it belongs in "
                                     "<joint>"});
}

}  // namespace
}  // namespace sdf_ccd
