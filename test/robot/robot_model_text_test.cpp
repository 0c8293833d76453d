#include <array>
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "robot/small_robots.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::robot_model_text_test {

using test::kArm;

std::string failure(const std::string& xml, const std::string& source = {}) {
  return test::failureOf([&] { RobotModel(xml, source); });
}

TEST(RobotModel, ParserFailuresGiveTheReason) {
  ::testing::internal::CaptureStderr();
  EXPECT_NE(failure("").find("cannot be parsed"), std::string::npos);
  EXPECT_NE(failure("<robot name='r'><link").find("cannot be parsed"), std::string::npos);
  EXPECT_NE(failure("<sdf/>").find("robot"), std::string::npos);
  EXPECT_NE(failure("<robot name='r'/>").find("cannot be parsed"), std::string::npos);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(failure("<robot name='r'><link", "arm.urdf").find("arm.urdf: the URDF cannot be parsed: "), 0U);
}

const std::string kFloats = ": it is taken to float, so that it is where tf has it";

std::string jointText(const std::string& name, const std::string& type, const std::string& parent,
                      const std::string& child, const std::string& rest = "") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child + "'/>" +
         rest + "</joint>";
}

/// A robot of three links whose second joint is the given one; and a fourth link, which is fine.
RobotModel withJoint(const std::string& joint) {
  return RobotModel("<robot name='r'><link name='a'/><link name='b'/><link name='c'/>" +
                    jointText("good", "continuous", "a", "b") + joint + "</robot>");
}

TEST(RobotModel, AJointWithoutKinematicsFloats) {
  for (const auto& [type, rest, why] :
       {std::array<std::string, 3>{"continuous", "<axis xyz='0 0 0'/>", "its axis is 0 0 0"},
        {"bendy", "", "bendy"},
        {"continuous", "<axis xyz='0 0 up'/>", "up"},
        {"fixed", "<origin xyz='1 2'/>", "1 2"},
        {"revolute", "<limit lower='low' upper='1' effort='1' velocity='1'/>", "low"},
        {"continuous", "<mimic joint='good' multiplier='x'/>", "x"},
        {"continuous", "<mimic/>", "mimic"}}) {
    const RobotModel robot = withJoint(jointText("bad", type, "b", "c", rest));
    EXPECT_EQ(robot.links().size(), 3U);
    EXPECT_EQ(robot.jointAbove(robot.find("c")).type, urdf::Joint::FLOATING) << rest;
    EXPECT_EQ(robot.jointAbove(robot.find("b")).type, urdf::Joint::CONTINUOUS) << rest;
    ASSERT_EQ(robot.warnings().size(), 1U) << rest;
    EXPECT_EQ(robot.warnings()[0].find("joint bad: "), 0U) << robot.warnings()[0];
    EXPECT_NE(robot.warnings()[0].find(why), std::string::npos) << robot.warnings()[0];
    EXPECT_NE(robot.warnings()[0].find(kFloats), std::string::npos) << robot.warnings()[0];
    EXPECT_EQ(robot.reach("a", Vector3d::Zero(), "c", Vector3d::Zero()), HUGE_VAL)
        << "nothing may follow from the joint";
    EXPECT_FALSE(robot.rigidlyJoined("b", "c") || robot.adjacent("b", "c"));
  }
}

/// Efforts, calibrations and the like say nothing about where links are.
TEST(RobotModel, WhatNobodyReadsCannotBeWrong) {
  for (const std::string rest :
       {"<limit lower='-1' upper='1'/>", "<limit lower='-1' upper='1' effort='strong' velocity='quick'/>",
        "<limit lower='-1' upper='1'/><dynamics/><safety_controller/><calibration rising='x'/>"}) {
    const RobotModel robot = withJoint(jointText("j", "revolute", "b", "c", rest));
    EXPECT_TRUE(robot.warnings().empty()) << rest;
    EXPECT_EQ(robot.jointAbove(robot.find("c")).limits->upper, 1.0);
  }
  const RobotModel robot = withJoint(jointText("j", "revolute", "b", "c"));
  EXPECT_EQ(robot.jointAbove(robot.find("c")).type, urdf::Joint::REVOLUTE);
  EXPECT_EQ(failure("<robot version='1.2'><material name='red'/><link name='a'><visual><geometry><sphere radius='1'/>"
                    "</geometry><material name='blue'/></visual></link></robot>"),
            "");
}

TEST(RobotModel, AMimicJointWithoutLeaderIsOneOfItsOwn) {
  for (const auto& [leader, why] :
       {std::pair<std::string, std::string>{"k", "k, which does not exist"}, {"j", "itself"}}) {
    const RobotModel robot = withJoint(jointText("j", "continuous", "b", "c", "<mimic joint='" + leader + "'/>"));
    EXPECT_EQ(robot.warnings(),
              std::vector<std::string>{"joint j mimics " + why + ": it is taken for a joint of its own"});
    EXPECT_FALSE(robot.jointAbove(robot.find("c")).mimic);
    EXPECT_EQ(robot.position(robot.jointAbove(robot.find("c")), {{"j", 0.3}}), 0.3);
  }
  // Two that follow each other, and one that follows a joint without a position.
  const RobotModel two(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/><link name='e'/>" +
      jointText("j", "continuous", "a", "b", "<mimic joint='k'/>") +
      jointText("k", "continuous", "b", "c", "<mimic joint='j' multiplier='2'/>") +
      jointText("f", "floating", "a", "d") + jointText("l", "continuous", "a", "e", "<mimic joint='f'/>") + "</robot>");
  EXPECT_EQ(two.warnings(),
            (std::vector<std::string>{"joint j mimics itself: it is taken for a joint of its own",
                                      "joint l mimics f, which has no position: it is taken for a joint of its own"}));
  EXPECT_EQ(two.position(two.jointAbove(two.find("c")), {{"j", 0.2}}), 0.4);
}

/// Each position is computed along the whole chain: thousands would take seconds a state.
TEST(RobotModel, LongChainsOfMimicJointsAreCut) {
  const auto chain = [](int length) {
    std::string urdf = "<robot name='r'><link name='l0'/>";
    for (int i = 1; i <= length; ++i) {
      const std::string number = std::to_string(i), before = std::to_string(i - 1);
      urdf += "<link name='l" + number + "'/>" +
              jointText("j" + number, "continuous", "l" + before, "l" + number,
                        i > 1 ? "<mimic joint='j" + before + "'/>" : "");
    }
    return RobotModel(urdf + "</robot>").warnings();
  };
  EXPECT_TRUE(chain(100).empty());
  EXPECT_EQ(chain(102), std::vector<std::string>{"joint j101 mimics a joint that mimics another, and so on, more than "
                                                 "100 times: it is taken for a joint of its own"});
}

TEST(RobotModel, LinksThatNoChainOfJointsLeadsToFloat) {
  const auto fixed = [](const std::string& name, const std::string& parent, const std::string& child) {
    return jointText(name, "fixed", parent, child);
  };
  const auto read = [](const std::string& content) { return RobotModel("<robot name='r'>" + content + "</robot>"); };
  const auto isFloating = [](const RobotModel& robot, const std::string& link) {
    return robot.jointAbove(robot.find(link)).type == urdf::Joint::FLOATING;
  };
  const std::string links = "<link name='a'/><link name='b'/><link name='c'/>";

  const RobotModel loop = read(links + fixed("there", "a", "b") + fixed("back", "b", "a"));
  EXPECT_EQ(loop.links().size(), 3U);
  EXPECT_EQ(loop.root(), "a") << "two links are below it, none below c";
  EXPECT_TRUE(isFloating(loop, "c"));
  EXPECT_TRUE(loop.rigidlyJoined("a", "b"));
  EXPECT_EQ(loop.warnings(),
            (std::vector<std::string>{"joint back is left out: it closes a loop",
                                      "no chain of joints leads from the root link a to link c" + kFloats}));

  const RobotModel two = read(links + fixed("to_b", "a", "b") + fixed("to_c", "a", "c") + fixed("closing", "b", "c"));
  EXPECT_TRUE(isFloating(two, "c"));
  EXPECT_TRUE(two.rigidlyJoined("a", "b"));
  EXPECT_EQ(two.warnings(), std::vector<std::string>{"link c is the child of two joints, to_c and closing" + kFloats});

  const RobotModel astray = read(links + fixed("to_b", "a", "b") + fixed("to_d", "a", "d") + fixed("of_d", "d", "c") +
                                 fixed("self", "b", "b") + "<joint name='none' type='fixed'/>");
  EXPECT_TRUE(isFloating(astray, "c"));
  EXPECT_EQ(astray.warnings(),
            (std::vector<std::string>{
                "joint to_d is left out: link d does not exist", "joint of_d is left out: link d does not exist",
                "joint self is left out: it joins link b to itself", "joint none is left out: it has no parent link",
                "no chain of joints leads from the root link a to link c" + kFloats}));

  // 2^40 paths lead to the last link.
  std::string ladder = "<link name='l0'/>";
  for (int i = 1; i <= 40; ++i) {
    const std::string from = "l" + std::to_string(i - 1), to = "l" + std::to_string(i);
    ladder += "<link name='" + to + "'/>" + fixed("p" + to, from, to) + fixed("q" + to, from, to);
  }
  const std::vector<std::string> many = read(ladder).warnings();
  ASSERT_EQ(many.size(), 21U);
  EXPECT_EQ(many.back(), "and 20 more joints or links like these");
}

/// A tail below a loop stays whole.
TEST(RobotModel, ALoopIsCutOnce) {
  const RobotModel robot("<robot name='r'><link name='tail'/><link name='a'/><link name='b'/><link name='c'/>" +
                         jointText("to_tail", "fixed", "c", "tail") + jointText("ab", "fixed", "a", "b") +
                         jointText("bc", "fixed", "b", "c") + jointText("ca", "fixed", "c", "a") + "</robot>");
  EXPECT_EQ(robot.links().size(), 4U);
  EXPECT_EQ(robot.warnings().size(), 1U);
  EXPECT_TRUE(robot.rigidlyJoined("tail", "a"));
}

TEST(RobotModel, NamesThatAreMissingOrTwiceCostNoOther) {
  const RobotModel robot("<robot name='r'><link name='a'/><link name='b'/><link name='b'/><link/>" +
                         jointText("j", "fixed", "a", "b") + "</robot>");
  EXPECT_EQ(robot.links().size(), 3U);
  EXPECT_EQ(robot.unread().at("b"), "line 1 of the URDF: a second link has this name");
  EXPECT_EQ(robot.warnings(),
            std::vector<std::string>{"no chain of joints leads from the root link a to link unnamed link of line 1" +
                                     kFloats});
  const RobotModel twice = withJoint(jointText("good", "continuous", "b", "c"));
  EXPECT_EQ(twice.warnings(),
            std::vector<std::string>{"the joint above link c has the name of another joint, good: it is named joint of "
                                     "link c"});
  EXPECT_EQ(withJoint("<joint type='fixed'><parent link='b'/><child link='c'/></joint>").warnings(),
            std::vector<std::string>{"the joint above link c has no name: it is named joint of link c"});
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
  const auto warnings = [](const std::string& inside) {
    return RobotModel("<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>\n" + inside +
                      "\n<link name='a'/></robot>")
        .warnings();
  };
  const std::vector<std::string> second_line{
      "line 2 of the URDF: xacro has not expanded it, and what it stands for is missing"};
  EXPECT_EQ(warnings("<xacro:arm prefix='l_'/>"), second_line);
  EXPECT_EQ(warnings("<gazebo><xacro:sensor/></gazebo>\n<xacro:include filename='b'/>"), second_line);
  EXPECT_EQ(warnings("<link name='${prefix}b'/><joint name='j' type='fixed'><parent link='a'/>"
                     "<child link='${prefix}b'/></joint>"),
            second_line);
  EXPECT_TRUE(warnings("<xacro:property name='x' value='1'/><xacro:macro name='arm' params=''><xacro:leg/>"
                       "</xacro:macro>")
                  .empty());
}

TEST(RobotModel, ShapesInNoLinkAreNamed) {
  const auto warnings = [](const std::string& inside, const std::string& behind = "") {
    return RobotModel("<robot name='r'><link name='a'/><link name='b'/>\n" + inside + "</robot>\n" + behind).warnings();
  };
  const std::string shape = "<collision><geometry><box size='1 1 1'/></geometry></collision>";
  const std::string link = "<link name='c'>" + shape + shape + "</link>";
  const std::string joint = "<joint name='j' type='fixed'><parent link='a'/><child link='b'/>";
  const auto unread = [](int line, const std::string& parent) {
    return std::vector<std::string>{"line " + std::to_string(line) + " of the URDF: <collision> in <" + parent +
                                    "> is not read"};
  };
  const std::string fixed = joint + "</joint>";
  EXPECT_TRUE(warnings(fixed).empty());
  EXPECT_EQ(warnings(fixed + "<group>" + link + "</group>"), unread(2, "link")) << "once for a link";
  EXPECT_EQ(warnings(fixed + "<Link name='c'>" + shape + "</Link>"), unread(2, "Link"));
  EXPECT_EQ(warnings(fixed + shape), unread(2, "robot"));
  EXPECT_EQ(warnings(joint + shape + "</joint>"), unread(2, "joint"));
  EXPECT_EQ(warnings(joint + "<axis xyz='1 0 0'>" + shape + "</axis></joint>"), unread(2, "axis"));
  EXPECT_EQ(warnings(joint + link + "</joint>"), unread(2, "link"));
  EXPECT_EQ(warnings(fixed + "<robot name='s'>" + link + "</robot>"), unread(2, "link"));
  EXPECT_EQ(warnings(fixed, "<robot name='s'>" + link + "</robot>"), unread(3, "link"));
  std::string many;
  for (int i = 0; i < 20; ++i) many += "<group>" + link + "</group>";
  EXPECT_EQ(warnings(fixed + many).size(), 10u);
  // Other formats' elements of these names, and definitions.
  EXPECT_TRUE(warnings(fixed + "<gazebo><model>" + link + "</model></gazebo><group name='arm'><link name='a'/>" +
                           "<joint name='j'/></group><plugin><collision>a</collision></plugin>" +
                           "<xacro:macro name='m' params=''>" + link + "</xacro:macro>",
                       "<about/>")
                  .empty());
}

TEST(RobotModel, TheRobotNeedNotBeTheFirstElement) {
  EXPECT_EQ(RobotModel("<about/>\n<robot name='r'><link name='a'/></robot>").links().size(), 1u);
}

}  // namespace sdf_ccd::robot_model_text_test
