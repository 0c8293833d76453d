// The assumptions behind pairs that are left out because the URDF's joints can never bring them near each other.

#include <gtest/gtest.h>

#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd {
namespace {

using test::message;
using test::stampedTransform;

/// Two wheels 2 m apart, and a ball in front of a wall, so that there is a pair to check.
class ReachGuardTest : public ::testing::Test {
 protected:
  ReachGuardTest() {
    MonitorParameters parameters = parseParameters({}, "~");
    const auto wheel = [](const std::string& name, const std::string& x) {
      return "<link name='" + name +
             "'><collision><geometry><sphere radius='0.1'/></geometry></collision></link><joint name='j_" + name +
             "' type='continuous'><parent link='base'/><child link='" + name + "'/><origin xyz='" + x +
             " 0 0'/><axis xyz='0 1 0'/></joint>";
    };
    parameters.urdf = "<robot name='cart'><link name='base'/>" + wheel("left", "-1") + wheel("right", "1") + "</robot>";
    parameters.scene.cache_directory.clear();
    WorldObject wall;
    wall.name = "wall";
    wall.frame = "elsewhere";
    wall.shapes = {{Primitive(Box{{0.1, 0.1, 0.1}})}};
    parameters.world.push_back(wall);
    described_ = describeScene(parameters, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    loop_ =
        std::make_unique<MonitorLoop>(buildDescribed(described_, plan, parameters.scene, {}), described_, parameters);
  }

  ContactArray cycleWithRightAt(double x) {
    loop_->history().add(message({stampedTransform("base", "elsewhere", time_, 50.0)}), true);
    TfTracker::Step step = TfTracker::Step::kWaiting;
    for (int i = 0; i < 5 && step != TfTracker::Step::kCycle; ++i) {  // the first step only begins
      loop_->history().add(message({stampedTransform("base", "left", time_, -1.0)}), false);
      loop_->history().add(message({stampedTransform("base", "right", time_, x)}), false);
      step = loop_->step(ros::Time(time_), {});
      time_ += 0.05;
    }
    EXPECT_EQ(step, TfTracker::Step::kCycle);
    return toContactArray(*loop_);
  }

  DescribedScene described_;
  std::unique_ptr<MonitorLoop> loop_;
  double time_ = 100.0;
};

TEST_F(ReachGuardTest, WhereTheUrdfHasThemTheyAreClear) {
  ASSERT_EQ(described_.unreachable.size(), 1u);
  EXPECT_EQ(cycleWithRightAt(1.0).verdict, ContactArray::CLEAR);
}

/// tf is that of another robot than the URDF: the wheels' poses are not reliable, and they may touch.
TEST_F(ReachGuardTest, WhereTfHasThemNearEachOtherTheyAreNotChecked) {
  const ContactArray said = cycleWithRightAt(-0.95);
  EXPECT_EQ(said.verdict, ContactArray::NOT_CHECKED);
  ASSERT_EQ(said.pairs.size(), 1u);
  EXPECT_EQ(said.pairs[0].body_a, "left");
  EXPECT_EQ(said.pairs[0].body_b, "right");
  EXPECT_NE(said.pairs[0].reason.find("out of reach according to the URDF, but close to each other in tf"),
            std::string::npos);
}

}  // namespace
}  // namespace sdf_ccd
