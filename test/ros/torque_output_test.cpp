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
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    loop_ =
        std::make_unique<MonitorLoop>(buildDescribed(described_, plan, parameters.scene, {}), described_, parameters);
  }

  /// @param late  how much older the arm's transforms are than the camera's [s].
  void step(double now, double late) {
    std::vector<geometry_msgs::TransformStamped> sent = {stampedTransform("base", "boom", now - late, 0.0),
                                                         stampedTransform("boom", "ball", now - late, 1.0),
                                                         stampedTransform("base", "camera", now, -5.0)};
    loop_->history().add(message(sent), false);
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

}  // namespace sdf_ccd::torque_output_test
