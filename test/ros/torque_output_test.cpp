#include "ros/monitor/torque_output.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "ros/monitor/cycle_messages.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::torque_output_test {

using test::message;
using test::stampedTransform;

/// A boom rotates about the base's z axis; at its end, 1 m away, a ball is pressed into a wall.
class TorqueOutputTest : public ::testing::Test {
 protected:
  TorqueOutputTest() {
    MonitorParameters parameters = parseParameters({}, "~");
    parameters.urdf =
        "<robot name='r'><link name='base'/><link name='boom'/><link name='ball'><collision><geometry><sphere "
        "radius='0.1'/>"
        "</geometry></collision></link><link name='lost'/>"
        "<joint name='turn' type='continuous'><parent link='base'/><child link='boom'/><axis xyz='0 0 1'/></joint>"
        "<joint name='slide' type='prismatic'><parent link='boom'/><child link='ball'/><origin xyz='1 0 0'/>"
        "<axis xyz='0 1 0'/><limit lower='-1' upper='1' effort='1' velocity='1'/></joint>"
        "<joint name='other' type='continuous'><parent link='base'/><child link='lost'/><axis xyz='0 0 "
        "1'/></joint>"
        "<link name='camera'><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
        "<joint name='stand' type='floating'><parent link='base'/><child link='camera'/></joint></robot>";
    parameters.scene.cache_directory.clear();
    WorldObject wall;
    wall.name = "wall";
    wall.frame = "base";
    wall.shapes = {
        {Primitive(Box::fromSize({1.0, 0.2, 1.0})), Eigen::Translation3d(1.0, 0.195, 0.0) * Isometry3d::Identity()}};
    parameters.world.push_back(wall);
    described_ = describeScene(parameters, [](const std::string&) { return Resource(); });
    parameters_ = parameters;
  }

  void SetUp() override {
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters_.scene));
    loop_ =
        std::make_unique<MonitorLoop>(buildDescribed(described_, plan, parameters_.scene, {}), described_, parameters_);
  }

  /// @param late  how much older the arm's transforms are than the camera's [s].
  void step(double now, double late) {
    std::vector<geometry_msgs::TransformStamped> sent = {stampedTransform("base", "boom", now - late, 0.0),
                                                         stampedTransform("boom", "ball", now - late, 1.0),
                                                         stampedTransform("base", "camera", now, -5.0)};
    loop_->history().add(message(sent), false);
    loop_->step(ros::Time(now), {});
  }

  /// The boom turns at 2 rad/s, with the camera beyond its ball, which presses on it along the boom.
  /// @param late  how much older the camera's transforms are than the arm's [s].
  void turnedStep(double now, double late) {
    const auto angleAt = [](double time) { return 0.6 + 2.0 * (time - 100.0); };
    const double angle = angleAt(now - late);
    const Quaterniond rotation(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
    loop_->history().add(
        message(
            {stampedTransform("base", "boom", now, 0.0, angleAt(now)), stampedTransform("boom", "ball", now, 1.0),
             stampedTransform("base", "camera", ros::Time(now - late), rotation, rotation * Vector3d(1.19, 0.0, 0.0))}),
        false);
    loop_->step(ros::Time(now), {});
  }

  sensor_msgs::JointState said() {
    TorqueOutput torques(described_);
    std::vector<int> links = torques.linksOf(loop_->scene());
    torques.swapLinks(links);
    sensor_msgs::JointState said;
    torques.set(*loop_, said);
    return said;
  }

  /// The wall presses the ball along -y, over a lever of 1 m about the boom's joint.
  void expectTorquesOfTheWall() {
    ASSERT_EQ(loop_->result().verdict, Verdict::kContact);
    const std::vector<PairResult>& pairs = loop_->result().pairs;
    const auto pair =
        std::find_if(pairs.begin(), pairs.end(), [](const PairResult& p) { return p.verdict == Verdict::kContact; });
    const bool is_ball_first = loop_->scene().bodies[pair->body_a].name == "ball";
    const Vector3d force = is_ball_first ? pair->on_a_W.force : pair->on_b_W.force;
    ASSERT_LT(force.y(), -1.0);
    const sensor_msgs::JointState said = this->said();
    ASSERT_EQ(said.name.size(), 3u);
    for (std::size_t i = 0; i < said.name.size(); ++i) {
      if (said.name[i] == "other") {
        EXPECT_TRUE(std::isnan(said.effort[i]));  // its transforms are not known
      } else {
        EXPECT_NEAR(said.effort[i], force.y(), 0.02 * -force.y()) << said.name[i];
      }
    }
    EXPECT_EQ(said.header.stamp, loop_->cycle().end);
  }

  MonitorParameters parameters_;
  DescribedScene described_;
  std::unique_ptr<MonitorLoop> loop_;
};

TEST_F(TorqueOutputTest, TheWallPressesOnTheJointsThatCarryTheBall) {
  for (int i = 0; i < 40; ++i) step(100.0 + 0.033 * i, 0.0);
  expectTorquesOfTheWall();
}

TEST_F(TorqueOutputTest, JointsWhoseTransformsAreOlderThanTheCyclesEndHaveTheirTorques) {
  for (int i = 0; i < 40; ++i) step(100.0 + 0.033 * i, 0.02);
  ASSERT_LT(loop_->cycle().complete_until, loop_->cycle().end);
  expectTorquesOfTheWall();
}

/// A push along the boom does not turn it, whenever it was checked.
TEST_F(TorqueOutputTest, WhatIsCheckedLateActsOnTheArmAsItWasThen) {
  for (const double late : {0.0, 0.1, 0.3}) {
    SetUp();
    for (int i = 0; i < 30; ++i) turnedStep(100.0 + 0.033 * i, late);
    double force = 0.0;
    for (const PairResult& pair : loop_->result().pairs)
      if (pair.verdict == Verdict::kContact) force = pair.on_a_W.force.norm();
    ASSERT_GT(force, 1.0) << late;
    const sensor_msgs::JointState said = this->said();
    for (std::size_t i = 0; i < said.name.size(); ++i)
      if (said.name[i] != "other") {
        EXPECT_LT(std::abs(said.effort[i]), 0.05 * force) << said.name[i] << " " << late;
      }
  }
}

}  // namespace sdf_ccd::torque_output_test
