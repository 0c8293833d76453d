// Pairs that a scene leaves out because their bodies do not move relative to each other, along motions that move them.
#include <gtest/gtest.h>

#include "robot/planned_motion.h"
#include "robot_monitor/check_motion_case.h"

namespace sdf_ccd::rigid_motion_test {

using namespace test;

/// A carriage on a rail, which its limits keep a metre away from the rail's post. A hand is rigidly joined to it.
constexpr const char* kRail = R"(<robot name='r'>
  <link name='base'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <link name='carriage'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <link name='hand'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>
  <joint name='slide' type='prismatic'><parent link='base'/><child link='carriage'/><origin xyz='3 0 0'/>
    <axis xyz='1 0 0'/><limit lower='-1' upper='0' effort='1' velocity='1'/></joint>
  <joint name='hold' type='fixed'><parent link='carriage'/><child link='hand'/><origin xyz='0 0 1'/></joint>
</robot>)";

class RigidMotion : public ::testing::Test {
 protected:
  RigidMotion() {
    std::vector<std::string> warnings;
    description_ = describeRobot(robot_, {}, {}, {true}, warnings);
    // Between bodies that may meet, so that there is something to check.
    BodyDescription ball;
    ball.name = "ball";
    ball.frame = "base";
    ball.X_frame_B = Eigen::Translation3d(0.0, 5.0, 0.0);
    ball.geometry.push_back({Primitive(Sphere{0.1}), Isometry3d::Identity(), "sphere"});
    ball.is_world = true;
    description_.bodies.push_back(ball);
  }

  std::shared_ptr<const Scene> scene() const {
    const BodyOptions options = optionsFor({4e-3, {}});
    return std::make_shared<const Scene>(
        buildScene(description_, planScene(description_, planOptions(options)), options));
  }

  PlannedJoints plan(double from, double to) const {
    RobotTrajectory trajectory;
    trajectory.times = {0.0, 1.0};
    trajectory.states.resize(2);
    trajectory.states[0].positions["slide"] = from;
    trajectory.states[1].positions["slide"] = to;
    return completePlan(robot_, trajectory, {}, {true});
  }

  const RobotModel robot_{kRail};
  SceneDescription description_;
};

/// Names of the pairs that are not checked, with their reasons.
std::vector<std::string> uncheckedOf(const Scene& scene, const CycleResult& result) {
  std::vector<std::string> names;
  for (const PairResult& pair : result.pairs)
    if (pair.verdict == Verdict::kNotChecked)
      names.push_back(scene.bodies[pair.body_a].name + " - " + scene.bodies[pair.body_b].name + ": " + pair.reason);
  return names;
}

TEST_F(RigidMotion, BeyondTheLimitsIsCheckedLikeAllOthers) {
  const auto scene = this->scene();
  ASSERT_EQ(scene->pairs.size(), 4u) << planTable(*scene);  // of base and ball with what moves
  EXPECT_EQ(checkMotion(scene, {}, planAlong(robot_, plan(0.0, -1.0), bodiesOf(*scene, robot_))).verdict,
            Verdict::kClear);
  EXPECT_EQ(checkMotion(scene, {}, planAlong(robot_, plan(0.0, -6.0), bodiesOf(*scene, robot_))).verdict,
            Verdict::kContact)
      << "the carriage goes through the base";
}

TEST_F(RigidMotion, WhatIsNotCarriedAsTheUrdfSaysIsNotChecked) {
  const auto scene = this->scene();
  PlannedBodies bodies = bodiesOf(*scene, robot_);
  bodies.bodies[2].link = -1;  // the hand stays behind
  bodies.bodies[2].X_LB = Eigen::Translation3d(3.0, 0.0, 1.0);
  const auto motion = [&](std::size_t i, double) { return planAlong(robot_, plan(0.0, i == 0 ? 0.0 : -1.0), bodies); };
  const CycleResult result = checkMotion(scene, {}, motion(1, 0.0));
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(uncheckedOf(*scene, result),
            std::vector<std::string>{"carriage - hand: rigidly joined in the scene, but not certainly in this motion"});
  MotionsRequest listed;
  listed.list_pairs = true;
  for (const MotionsRequest& request : {MotionsRequest(), listed}) {
    const std::vector<MotionVerdict> verdicts = checkMotions(scene, {}, 2, motion, request);
    EXPECT_EQ(verdicts[0].verdict, Verdict::kClear);
    EXPECT_TRUE(verdicts[0].unchecked.empty());
    EXPECT_EQ(verdicts[1].verdict, Verdict::kNotChecked);
    EXPECT_EQ(verdicts[1].pair, -1);
    EXPECT_EQ(verdicts[1].time, 0.0);
    EXPECT_EQ(verdicts[1].unchecked.size(), 1u);
    EXPECT_EQ(verdicts[1].pairs.size(), request.list_pairs ? 1u : 0u);
  }
}

TEST_F(RigidMotion, PosesThatContradictTheSceneAreNotChecked) {
  BodyDescription tool = description_.bodies.back();
  tool.name = "tool";
  tool.frame = "hand";
  tool.X_frame_B = Eigen::Translation3d(0.0, 0.0, 0.3);
  tool.is_world = false;
  description_.bodies.push_back(tool);
  const auto scene = this->scene();
  const auto at = [](const Vector3d& p) { return Isometry3d(Eigen::Translation3d(p)); };
  const auto verdict = [&](const Vector3d& carriage, const Vector3d& hand, const Vector3d& tool) {
    CycleMotion motion;
    motion.times = {0.0, 1.0};
    motion.X_WB = {{at({0, 0, 0})},
                   {at({3, 0, 0}), at(carriage)},
                   {at({3, 0, 1}), at(hand)},
                   {at({0, 5, 0})},
                   {at({3, 0, 1.3}), at(tool)}};
    return checkMotion(scene, {}, planThrough(motion)).verdict;
  };
  EXPECT_EQ(verdict({2, 0, 0}, {2, 0, 1}, {2, 0, 1.3}), Verdict::kClear);
  EXPECT_EQ(verdict({-3, 0, 0}, {-3, 0, 1}, {-3, 0, 1.3}), Verdict::kContact) << "through the base";
  EXPECT_EQ(verdict({2, 0, 0}, {2, 0, 0.1}, {2, 0, 0.4}), Verdict::kNotChecked) << "the hand into the carriage";
  EXPECT_EQ(verdict({2, 0, 0}, {2, 0, 1}, {2, 0, 1.1}), Verdict::kNotChecked) << "the tool, in the frame of the hand";
}

TEST_F(RigidMotion, ThatKnowsOneOfTwoBodiesIsNotChecked) {
  for (const char* other : {"base", "ball"})
    description_.allowed.push_back({other, "hand", "so that nothing else needs the hand"});
  const auto scene = this->scene();
  const auto verdict = [&](const std::string& carriage, const std::string& hand) {
    CycleMotion motion;
    motion.times = {0.0, 1.0};
    motion.X_WB.assign(4, {Isometry3d::Identity()});
    motion.X_WB[1][0].translation().y() = 3.0;
    motion.X_WB[3][0].translation().y() = 5.0;
    motion.X_WB[2][0] = motion.X_WB[1][0] * Eigen::Translation3d(0.0, 0.0, 1.0);
    motion.missing = {"", carriage, hand, ""};
    return checkMotion(scene, {}, planThrough(motion)).verdict;
  };
  EXPECT_EQ(verdict("", ""), Verdict::kClear);
  EXPECT_EQ(verdict("", "gone"), Verdict::kNotChecked);
}

}  // namespace sdf_ccd::rigid_motion_test
