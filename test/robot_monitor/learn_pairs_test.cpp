#include "robot_monitor/learn_pairs.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "robot/joint_sampler.h"
#include "robot/srdf_pairs.h"

namespace sdf_ccd::learn_pairs_test {

using Names = std::set<std::string>;  // "a b"

Resource noResource(const std::string& uri) {
  throw std::runtime_error("no " + uri);
}

std::string sphere(const std::string& link, double x, double radius = 0.1) {
  return "<link name='" + link + "'><collision><origin xyz='" + std::to_string(x) +
         " 0 0'/><geometry><sphere radius='" + std::to_string(radius) + "'/></geometry></collision></link>";
}

std::string joint(const std::string& parent, const std::string& child, const std::string& type,
                  const std::string& rest = "") {
  return "<joint name='to_" + child + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><axis xyz='0 0 1'/>" + rest + "</joint>";
}

std::string limits(double lower, double upper) {
  return "<limit lower='" + std::to_string(lower) + "' upper='" + std::to_string(upper) + "' effort='1' velocity='1'/>";
}

/// Arms that rotate about one axis, each with a sphere of radius 0.1; their distances follow from their angles.
std::string scissors() {
  return "<robot name='scissors'>" + sphere("base", 0.0) +                             //
         sphere("a", 1.0) + joint("base", "a", "continuous") +                         // a full revolution
         sphere("b", 1.0) + joint("base", "b", "revolute", limits(0.5, 1.0)) +         // at least 0.5 rad from c
         sphere("c", 1.0, 0.08) + joint("base", "c", "revolute", limits(-1.0, 0.0)) +  //
         sphere("d", 2.0) + joint("base", "d", "continuous") +                         // 0.8 m from all others
         sphere("e", 1.0) + joint("base", "e", "continuous", "<mimic joint='to_a' offset='3.14159265'/>") +
         sphere("f", 0.0, 0.1) + joint("a", "f", "continuous", "<origin xyz='0.05 0 0'/>") +  // 5 cm from base's sphere
         sphere("g", 3.0) + joint("base", "g", "revolute", limits(0.0, 0.0)) +                // no limits
         sphere("h", 3.0) + joint("base", "h", "floating") + "</robot>";
}

/// Spheres whose shells are built quickly.
LearnOptions coarse() {
  LearnOptions options;
  options.max_error = 0.02;
  return options;
}

LearnedPairs learn(const std::string& urdf, const LearnOptions& options = coarse(), const Srdf& srdf = {}) {
  return learnPairs(RobotModel(urdf), srdf, noResource, options);
}

Names namesOf(const std::vector<PairDecision>& pairs, const std::string& reason = "") {
  Names names;
  for (const PairDecision& pair : pairs) {
    if (reason.empty() || srdfReason(pair.kind) == reason) {
      names.insert(std::min(pair.body_a, pair.body_b) + " " + std::max(pair.body_a, pair.body_b));
    }
  }
  return names;
}

TEST(LearnPairs, FindsWhatTheAnglesSay) {
  LearnOptions options = coarse();
  options.states = 2000;
  const LearnedPairs pairs = learn(scissors(), options);
  EXPECT_EQ(namesOf(pairs.disabled, "Adjacent"),
            (Names{"a base", "b base", "base c", "base d", "base e", "a f", "base g"}));
  EXPECT_EQ(namesOf(pairs.disabled, "Always"), (Names{"base f"}));
  EXPECT_EQ(namesOf(pairs.touching), (Names{"a b", "a c", "b e", "c e"}));
  Names never = {"b c", "a e"};  // because of a limit, and of a mimic joint
  for (const char* pair : {"a d", "b d", "c d", "d e", "d f", "a g", "b g", "c g", "d g", "e g", "f g"}) {
    never.insert(pair);
  }
  for (const char* pair : {"b f", "c f", "e f"}) never.insert(pair);
  EXPECT_EQ(namesOf(pairs.disabled, "Never"), never);
  EXPECT_EQ(namesOf(pairs.unknown), (Names{"a h", "b h", "base h", "c h", "d h", "e h", "f h", "g h"}));
  EXPECT_EQ(pairs.unknown.front().text, "joint to_h is unbounded");
  EXPECT_EQ(pairs.warnings, std::vector<std::string>{"joint to_g has no limits: a full revolution is sampled"});
  EXPECT_TRUE(pairs.close.empty());
  EXPECT_TRUE(namesOf(pairs.at_default).count("a c") > 0);  // both at 0; b is at 0.5
  EXPECT_LE(pairs.error_bound, options.max_error);
}

TEST(LearnPairs, WhatIsNearerThanTheBoundIsNotLeftOut) {
  // Rigidly joined 5 mm and 5 cm apart, with a link between them.
  const auto urdf = [](double gap) {
    return "<robot name='r'>" + sphere("a", 0.0) + sphere("m", 5.0) + joint("a", "m", "fixed") +
           sphere("b", 0.2 + gap) + joint("m", "b", "fixed") + "</robot>";
  };
  LearnOptions options = coarse();
  options.states = 10;
  EXPECT_EQ(namesOf(learn(urdf(0.005), options).close), Names{"a b"});
  EXPECT_EQ(namesOf(learn(urdf(0.05), options).disabled, "Never"), Names{"a b"});
  EXPECT_EQ(namesOf(learn(urdf(-0.05), options).disabled, "Always"), Names{"a b"});
}

/// A joint that follows a continuous one need not be back where it was after a revolution of that.
TEST(LearnPairs, JointsThatFollowContinuousOnesTakeAllTheirPositions) {
  const auto follow = [](const std::string& multiplier) {
    return "<mimic joint='to_a' multiplier='" + multiplier + "' offset='0.1'/>";
  };
  const auto fixed = [](const std::string& link, const std::string& origin) {
    return sphere(link, 1.0) + joint("base", link, "fixed", "<origin " + origin + "/>");
  };
  std::string urdf = "<robot name='r'>" + sphere("base", 0.0) + sphere("a", 1.0) + joint("base", "a", "continuous");
  urdf += sphere("slow", 1.0) + joint("base", "slow", "continuous", follow("0.25"));
  urdf += sphere("elbow", 1.0) + joint("a", "elbow", "continuous", "<origin xyz='1 0 0'/>" + follow("1.5"));
  urdf += sphere("screw", 1.0) + joint("base", "screw", "prismatic", limits(-0.5, 0.6) + follow("0.01"));
  urdf += sphere("free", 1.0) + joint("base", "free", "prismatic", limits(0.0, 0.0) + follow("0.01"));
  // Where the elbow is at 1 and 1.6 + pi rad, as after a revolution of a.
  urdf += fixed("aside", "xyz='0.397 0.327 0'") + fixed("behind", "rpy='0 0 -2.5'") + fixed("above", "xyz='0 0 0.6'");
  LearnOptions options = coarse();
  options.states = 1000;
  const LearnedPairs pairs = learn(urdf + "</robot>", options);
  const Names touching = namesOf(pairs.touching);
  EXPECT_EQ(touching.count("behind slow"), 1u);
  EXPECT_EQ(touching.count("aside elbow"), 1u);
  EXPECT_EQ(touching.count("above screw"), 1u);
  EXPECT_EQ(namesOf(pairs.unknown).count("above free"), 1u);
}

TEST(LearnPairs, ThreadsDoNotMatterAndSeedsDo) {
  LearnOptions options = coarse();
  options.states = 300;
  const RobotModel robot(scissors());
  const auto text = [&] { return srdfWith(learnPairs(robot, {}, noResource, options), robot, ""); };
  const std::string all = text();
  {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(text(), all);
  }
  options.seed = 2;
  EXPECT_NE(text(), all);
}

/// Also of a joint that follows another one.
TEST(LearnPairs, PairsThatTouchBeyondLimitsAreNotLeftOut) {
  const auto slide = [](const std::string& child, const std::string& rest) {
    return "<joint name='to_" + child + "' type='prismatic'><parent link='base'/><child link='" + child +
           "'/><axis xyz='1 0 0'/>" + limits(-0.02, 0.02) + rest + "</joint>";
  };
  const std::string urdf = "<robot name='r'>" + sphere("base", 0.0) + sphere("m", 5.0) + joint("base", "m", "fixed") +
                           sphere("a", 1.0) + slide("a", "") + sphere("b", -1.0) +
                           slide("b", "<mimic joint='to_a' multiplier='-1'/>") + sphere("c", 0.0, 3.0) +
                           joint("m", "c", "continuous", "<origin xyz='-5 0 0'/>") + "</robot>";
  LearnOptions options = coarse();
  options.states = 0;
  options.recorded = {{"to_a"}, {{0.0}, {0.01}}};
  EXPECT_TRUE(namesOf(learn(urdf, options).disabled, "Never").count("a b") > 0);
  options.recorded.positions.push_back({-1.0});  // both at the origin
  const LearnedPairs pairs = learn(urdf, options);
  EXPECT_EQ(namesOf(pairs.disabled, "Never").count("a b"), 0u);
  EXPECT_EQ(namesOf(pairs.touching).count("a b"), 1u);
}

TEST(LearnPairs, RecordedStatesCount) {
  LearnOptions options = coarse();
  options.states = 0;
  EXPECT_THROW(learn(scissors(), options), std::invalid_argument);
  options.recorded = {{"to_a"}, {{0.2}}};  // c stays at 0, b at 0.5
  EXPECT_TRUE(namesOf(learn(scissors(), options).disabled, "Never").count("a b") > 0);
  options.recorded.positions.push_back({0.52});
  EXPECT_TRUE(namesOf(learn(scissors(), options).touching).count("a b") > 0);
  options.default_pairs = true;
  EXPECT_TRUE(namesOf(learn(scissors(), options).disabled, "Default").count("a c") > 0);
}

/// All of the surfaces of a and b coincide at rest, so that the monitor would say UNCERTAIN there.
TEST(LearnPairs, DefaultCoversPairsThatAreUncertainAtRest) {
  const auto cube = [](const std::string& link) {
    return "<link name='" + link +
           "'><collision><origin xyz='1 0 0'/><geometry><box size='0.3 0.3 0.3'/></geometry></collision></link>" +
           joint("base", link, "continuous");
  };
  const std::string urdf = "<robot name='r'>" + sphere("base", 0.0) + cube("a") + cube("b") + "</robot>";
  LearnOptions options = coarse();
  options.states = 500;
  const LearnedPairs without = learn(urdf, options);
  EXPECT_EQ(namesOf(without.touching), Names{"a b"});
  EXPECT_EQ(namesOf(without.at_default), Names{"a b"});
  options.default_pairs = true;
  EXPECT_EQ(namesOf(learn(urdf, options).disabled, "Default"), Names{"a b"});
}

/// As at start-up: a car 0.5 mm above its rail, with a link without a shape between them, which hits a stop or not.
TEST(LearnPairs, NeighboursThatAJointHoldsTogetherAreAlways) {
  const auto disabled = [](double stop) {
    const auto box = [](const std::string& size, const std::string& xyz) {
      return "<collision><origin xyz='" + xyz + "'/><geometry><box size='" + size + "'/></geometry></collision>";
    };
    const std::string urdf = "<robot name='slide'><link name='rail'>" + box("6 0.1 0.1", "0 0 0") +
                             box("0.2 0.1 0.1", std::to_string(stop + 0.1) + " 0 0.1") + "</link><link name='motor'/>" +
                             joint("rail", "motor", "fixed") + "<link name='car'>" + box("0.2 0.1 0.1", "0 0 0.1005") +
                             "</link><joint name='to_car' type='prismatic'><parent link='motor'/><child link='car'/>"
                             "<axis xyz='1 0 0'/>" +
                             limits(-1.0, 1.0) + "</joint></robot>";
    LearnOptions options = coarse();
    options.states = 200;
    return namesOf(learn(urdf, options).disabled, "Always");
  };
  EXPECT_EQ(disabled(2.0), Names{"car rail"});
  EXPECT_EQ(disabled(0.7), Names{});
}

TEST(LearnPairs, TheFileKeepsWhatWasGivenAndIsHonest) {
  const std::string given =
      "<?xml version=\"1.0\"?>\n<!-- mine -->\n<robot name=\"scissors\">\n"
      "<group name=\"arm\"><chain base_link=\"base\" tip_link=\"a\"/></group>\n"
      "<disable_collisions link1=\"b\" link2=\"a\" reason=\"User\"/>\n</robot>";
  LearnOptions options = coarse();
  options.states = 1000;
  const RobotModel robot(scissors());
  const LearnedPairs pairs = learnPairs(robot, parseSrdf(given), noResource, options);
  EXPECT_EQ(pairs.known, 1u);
  const std::string text = srdfWith(pairs, robot, given);
  const Srdf srdf = parseSrdf(text);
  EXPECT_EQ(srdf.disabled.size(), 1u + pairs.disabled.size());
  EXPECT_EQ(srdf.disabled[0].text, "SRDF: User");
  for (const char* part : {"<!-- mine -->", "<group name=\"arm\">", "1000 random states (seed 1)", "NO PROOF",
                           "less than 0.3 % of states", "reason=\"Always\"/>"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  }
  EXPECT_EQ(text.find("link1=\"a\" link2=\"b\""), std::string::npos);
  // Without a given SRDF the result is an SRDF too; with it, only touching pairs remain to be learned.
  const Srdf own = parseSrdf(srdfWith(pairs, robot, ""));
  EXPECT_EQ(own.disabled.size(), pairs.disabled.size());
  EXPECT_TRUE(learnPairs(robot, parseSrdf(text), noResource, options).disabled.empty());
  EXPECT_THROW(srdfWith(pairs, robot, "<robot"), std::runtime_error);
  // What is not text is taken for question marks, as when it was read.
  std::string damaged = given;
  damaged[damaged.find("mine")] = '\0';
  EXPECT_EQ(parseSrdf(srdfWith(pairs, robot, damaged)).disabled.size(), srdf.disabled.size());
}

TEST(LearnPairs, AMeshThatIsMissingCostsItsPairsAlone) {
  const LearnedPairs pairs = learn("<robot name='r'>" + sphere("a", 0.0) + sphere("m", 3.0) + joint("a", "m", "fixed") +
                                   "<link name='b'><collision><geometry><mesh filename='package://x/y.stl'/></geometry>"
                                   "</collision></link>" +
                                   joint("m", "b", "fixed") + sphere("c", 1.0) + joint("m", "c", "fixed") + "</robot>");
  EXPECT_EQ(namesOf(pairs.unknown), (Names{"a b", "b c"}));
  EXPECT_NE(pairs.unknown[0].text.find("package://x/y.stl"), std::string::npos);
  EXPECT_EQ(namesOf(pairs.disabled, "Never"), Names{"a c"});
}

/// As for a mesh in millimetres: coarser fields and shells took minutes, for less accuracy than was requested.
TEST(LearnPairs, AnErrorThatNeedsTooMuchMemoryIsRefused) {
  LearnOptions options = coarse();
  options.max_error = 1e-8;
  const std::string failure = test::failureOf<std::length_error>([&] { learn(scissors(), options); });
  EXPECT_EQ(failure.find("a max_error of 1e-08 m is too small for base: "), 0u) << failure;
}

/// Also of those that cost nothing here, as their pairs need no test.
TEST(LearnPairs, AsksWhetherMeshesAreInMillimetres) {
  const auto part = [](const std::string& link, const std::string& file) {
    return "<link name='" + link + "'><collision><geometry><mesh filename='" + file +
           "'/></geometry></collision></link>";
  };
  const std::string urdf = "<robot name='r'>" + sphere("base", 0.0) + part("arm", "part.off") +
                           joint("base", "arm", "continuous") + part("hand", "small.off") +
                           joint("arm", "hand", "continuous", "<origin xyz='1 0 0'/>") + part("twin", "part.off") +
                           joint("base", "twin", "fixed") + "</robot>";
  const ResourceLoader loader = [](const std::string& uri) -> Resource {
    return {test::off(test::boxMesh(Vector3d::Constant(uri == "part.off" ? 160.0 : 0.16))), uri, ""};
  };
  const Srdf srdf = parseSrdf("<robot name='r'><disable_default_collisions link='twin'/></robot>");
  LearnOptions options = coarse();
  options.states = 2;
  EXPECT_EQ(learnPairs(RobotModel(urdf), srdf, loader, options).warnings,
            std::vector<std::string>{"arm: part.off: 320 m long: is it in millimetres? Meshes are taken to be in "
                                     "metres, times their scale"});
}

/// The demo's arm: the elbow bends to 2.7 rad at most, so that the wrist's axis, 0.35 m behind it, stays 0.149 m from
/// the upper arm's; the two are 0.032 and less than 0.06 m thick. Folded, the hand reaches the turret.
TEST(LearnPairs, TheDemoArm) {
  const RobotModel robot(test::readText(SDF_CCD_SOURCE_DIR "/config/demo/arm.urdf"));
  const ResourceLoader loader = [](const std::string& uri) {
    return loadLocalResource(
        uri, [](const std::string&) { return std::string(SDF_CCD_SOURCE_DIR); }, "");
  };
  LearnOptions options = coarse();
  options.states = 2000;
  const LearnedPairs pairs = learnPairs(robot, {}, loader, options);
  EXPECT_EQ(namesOf(pairs.disabled, "Adjacent"),
            (Names{"base turret", "turret upper_arm", "forearm upper_arm", "forearm wrist", "hand wrist"}));
  EXPECT_EQ(namesOf(pairs.disabled, "Always"), Names());
  EXPECT_TRUE(namesOf(pairs.disabled, "Never").count("upper_arm wrist") > 0);
  EXPECT_TRUE(namesOf(pairs.touching).count("hand turret") > 0);
  EXPECT_TRUE(pairs.unknown.empty());
}

/// MoveIt's setup assistant has tested the Panda with FCL. We leave out no pair that it does not, for the same reasons,
/// and all that it does except two.
TEST(LearnPairs, AgreesWithTheSetupAssistantOnAPanda) {
  SDF_CCD_NEEDS_DATA("robots/panda_from_xacro.urdf");
  const std::string robots = test::dataPath("robots");
  ::setenv("ROS_PACKAGE_PATH", robots.c_str(), 1);
  const PackageFinder packages = packagesFromEnvironment();
  const RobotModel robot(test::readText(robots + "/panda_from_xacro.urdf"));
  const Srdf theirs = parseSrdf(test::readText(robots + "/panda_moveit_config/config/panda.srdf"));
  const ResourceLoader loader = [&](const std::string& uri) { return loadLocalResource(uri, packages, ""); };
  LearnOptions options;
  options.states = 1000;
  const LearnedPairs pairs = learnPairs(robot, {}, loader, options);
  std::map<std::string, std::string> reasons;
  for (const PairDecision& pair : theirs.disabled) {
    reasons[std::min(pair.body_a, pair.body_b) + " " + std::max(pair.body_a, pair.body_b)] = pair.text;
  }
  for (const PairDecision& pair : pairs.disabled) {
    const std::string names = *namesOf({pair}).begin();
    EXPECT_EQ(reasons[names], std::string("SRDF: ") + srdfReason(pair.kind)) << names;
    reasons.erase(names);
  }
  EXPECT_LE(reasons.size(),
            2u);  // fingers that touch at 0 (its Default), and links 2 and 6, which touch in some states
}

TEST(JointSampler, DrawsWithinLimitsAndAllOfThem) {
  const RobotModel robot(scissors());
  JointSampler sampler(robot, 7), same(robot, 7);
  std::map<std::string, std::vector<double>> drawn;
  for (int i = 0; i < 4000; ++i) {
    const JointPositions positions = sampler.next();
    EXPECT_EQ(positions, same.next());
    for (const auto& [name, position] : positions) drawn[name].push_back(position);
  }
  EXPECT_EQ(drawn.size(), 6u);  // without the mimic and the floating joint
  const std::map<std::string, std::pair<double, double>> ranges = {
      {"to_a", {-M_PI, M_PI}}, {"to_b", {0.5, 1.0}}, {"to_c", {-1.0, 0.0}}, {"to_g", {-M_PI, M_PI}}};
  for (const auto& [name, range] : ranges) {
    const auto [least, greatest] = std::minmax_element(drawn[name].begin(), drawn[name].end());
    const double width = range.second - range.first;
    EXPECT_GE(*least, range.first) << name;
    EXPECT_LE(*greatest, range.second) << name;
    EXPECT_LE(*least, range.first + 0.01 * width) << name;
    EXPECT_GE(*greatest, range.second - 0.01 * width) << name;
    const auto lower_half =
        std::count_if(drawn[name].begin(), drawn[name].end(), [&](double q) { return q < range.first + 0.5 * width; });
    EXPECT_NEAR(double(lower_half), 2000.0, 160.0) << name;  // five standard deviations
  }
  EXPECT_GT(std::count(drawn["to_b"].begin(), drawn["to_b"].end(), 1.0), 150);  // at its limit
}

}  // namespace sdf_ccd::learn_pairs_test
