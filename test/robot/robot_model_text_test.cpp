#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "robot/small_robots.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {
namespace {

using test::kArm;
using test::twoLinks;

std::string failure(const std::string& xml, const std::string& source = {}) {
  return test::failureOf([&] { RobotModel(xml, source); });
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
