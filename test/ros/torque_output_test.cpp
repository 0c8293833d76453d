#include "ros/monitor/torque_output.h"

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
        "1'/></joint></robot>";
    parameters.scene.cache_directory.clear();
    WorldObject wall;
    wall.name = "wall";
    wall.frame = "base";
    wall.shapes = {{Primitive(Box{{0.5, 0.1, 0.5}}), Eigen::Translation3d(1.0, 0.195, 0.0) * Isometry3d::Identity()}};
    parameters.world.push_back(wall);
    described_ = describeScene(parameters, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    loop_ =
        std::make_unique<MonitorLoop>(buildDescribed(described_, plan, parameters.scene, {}), described_, parameters);
  }

  void step(double now) {
    loop_->history().add(
        message({stampedTransform("base", "boom", now, 0.0), stampedTransform("boom", "ball", now, 1.0)}), false);
    loop_->step(ros::Time(now), {});
  }

  DescribedScene described_;
  std::unique_ptr<MonitorLoop> loop_;
};

TEST_F(TorqueOutputTest, TheWallPressesOnTheJointsThatCarryTheBall) {
  for (int i = 0; i < 40; ++i) step(100.0 + 0.033 * i);
  ASSERT_EQ(loop_->result().verdict, Verdict::kContact);
  TorqueOutput torques(described_);
  std::vector<int> links = torques.linksOf(loop_->scene());
  torques.swapLinks(links);
  sensor_msgs::JointState said;
  torques.set(*loop_, said);
  const PairResult& pair = loop_->result().pairs.at(0);
  const Vector3d force = loop_->scene().bodies[pair.body_a].name == "ball" ? pair.on_a_W.force : pair.on_b_W.force;
  ASSERT_LT(force.y(), -1.0);
  ASSERT_EQ(said.name.size(), 3u);
  for (std::size_t i = 0; i < said.name.size(); ++i) {
    if (said.name[i] == "other") {
      EXPECT_TRUE(std::isnan(said.effort[i]));  // its transforms are not known
    } else {
      EXPECT_NEAR(said.effort[i], force.y(), 0.02 * -force.y()) << said.name[i];  // over a lever of 1 m
    }
  }
  EXPECT_EQ(said.header.stamp, loop_->cycle().end);
}

}  // namespace sdf_ccd::torque_output_test
