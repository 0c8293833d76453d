#include "robot_monitor/robot_pair_traits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/scene_case.h"

namespace sdf_ccd::robot_pair_traits_test {

const char* const kWrist = R"(<robot name="w">
  <link name="forearm"/><link name="wrist"/><link name="flange"/>
  <joint name="j1" type="revolute"><parent link="forearm"/><child link="wrist"/><origin xyz="0 0 0.1"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="j2" type="revolute"><parent link="wrist"/><child link="flange"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint></robot>)";

/// The traits of the pair of forearm and flange, with these shapes.
PairTraits traitsOf(const test::Shape& forearm, const test::Shape& flange, double beside,
                    const std::vector<PairLimit>& limits = {}, bool is_world = false) {
  SceneDescription description{{test::body("forearm", forearm), test::body("flange", flange)}, {}};
  description.bodies[1].geometry[0].X_BG = test::translation({beside, 0.0, 0.03});
  description.bodies[1].is_world = is_world;
  const auto robot = std::make_shared<const RobotModel>(kWrist);
  RobotPairTraits finder(
      robot, [&](const std::string& frame) { return robot->find(frame); }, limits);
  const std::vector<PairTraits> traits = finder.of(*test::build(description, test::fine(0.02)), description);
  EXPECT_EQ(traits.size(), 1u);
  EXPECT_EQ(finder.of(*test::build(description, test::fine(0.02)), description)[0].max_closing, traits[0].max_closing);
  return traits[0];
}

TEST(RobotPairTraits, WhatTurnsInItselfKeepsItsDistance) {
  const Primitive round = Cylinder::fromRadiusAndLength(0.05, 0.2), square = Box::fromSize({0.1, 0.1, 0.2}),
                  small = Cylinder::fromRadiusAndLength(0.04, 0.02), slab = Box::fromSize({0.08, 0.04, 0.02});
  EXPECT_TRUE(traitsOf(round, small, 0.0).is_constant);
  EXPECT_TRUE(traitsOf(round, slab, 0.0).is_constant);  // the forearm turns in itself, seen from the flange
  EXPECT_TRUE(traitsOf(square, small, 0.0).is_constant);
  EXPECT_FALSE(traitsOf(square, slab, 0.0).is_constant);
  EXPECT_TRUE(traitsOf(round, small, 0.01).is_constant);
  EXPECT_FALSE(traitsOf(square, small, 0.01).is_constant);  // off the axis
  EXPECT_TRUE(traitsOf(round, small, 0.0).is_own);
  EXPECT_LT(traitsOf(round, small, 0.0).max_closing, 0.5);  // two joints of 1 rad/s, some 0.1 m from their axis
}

TEST(RobotPairTraits, PairsWithTheWorldAreNotOwn) {
  const PairTraits traits =
      traitsOf(Cylinder::fromRadiusAndLength(0.05, 0.2), Cylinder::fromRadiusAndLength(0.04, 0.02), 0.0, {}, true);
  EXPECT_FALSE(traits.is_own);
  EXPECT_FALSE(traits.is_constant);
  EXPECT_TRUE(std::isinf(traits.max_closing));
}

TEST(RobotPairTraits, WhatIsRigidlyJoinedKeepsItsDistance) {
  SceneDescription description{
      {test::body("forearm", Box::fromSize({0.1, 0.1, 0.2})), test::body("held", Box::fromSize({0.2, 0.2, 0.2}))}, {}};
  description.bodies[1].frame = "tool";
  const auto robot = std::make_shared<const RobotModel>(R"(<robot name="r"><link name="forearm"/><link name="tool"/>
    <joint name="j" type="fixed"><parent link="forearm"/><child link="tool"/></joint></robot>)");
  RobotPairTraits finder(robot, [&](const std::string& frame) { return robot->find(frame); }, {});
  const std::vector<PairTraits> traits = finder.of(*test::build(description, test::fine(0.02)), description);
  ASSERT_EQ(traits.size(), 1u);
  EXPECT_TRUE(traits[0].is_constant);
}

TEST(RobotPairTraits, TheLastLimitThatMatchesCounts) {
  const Primitive round = Cylinder::fromRadiusAndLength(0.05, 0.2), small = Cylinder::fromRadiusAndLength(0.04, 0.02);
  EXPECT_FALSE(traitsOf(round, small, 0.0).stop_distance);
  EXPECT_EQ(traitsOf(round, small, 0.0, {{{"*", "*"}, 0.1}, {{"fl*", "forearm"}, 0.01}}).stop_distance, 0.01);
  EXPECT_EQ(traitsOf(round, small, 0.0, {{{"fl*", "forearm"}, 0.01}, {{"*", "*"}, 0.1}}).stop_distance, 0.1);
  EXPECT_EQ(traitsOf(round, small, 0.0, {{{"flange", "forearm"}, 0.01}, {{"flange", "table"}, 0.1}}).stop_distance,
            0.01);
}

}  // namespace sdf_ccd::robot_pair_traits_test
