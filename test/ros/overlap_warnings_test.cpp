// Which pairs overlap at rest, and are set aside or checked, is in state.warnings, also when the scene changes.

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd::overlap_warnings_test {

/// A base that holds a wheel on a caster, 10 cm deep, and a boom above that bends into it over three hinges.
class OverlapWarnings : public ::testing::Test {
 protected:
  OverlapWarnings() {
    const auto link = [](const std::string& name, const std::string& shape, const std::string& z = "0") {
      return "<link name='" + name + "'><collision><origin xyz='0 0 " + z + "'/><geometry>" + shape +
             "</geometry></collision></link>";
    };
    const auto hinge = [](const std::string& parent, const std::string& child, const std::string& z) {
      return "<joint name='to_" + child + "' type='continuous'><parent link='" + parent + "'/><child link='" + child +
             "'/><origin xyz='0 0 " + z + "'/><axis xyz='0 1 0'/></joint>";
    };
    const std::string ball = "<sphere radius='0.01'/>";
    parameters_.urdf = "<robot name='cart'>" + link("base", "<box size='1 1 0.2'/>") + link("caster", ball, "-0.5") +
                       link("wheel", "<sphere radius='0.04'/>") + link("l1", ball, "9") + link("l2", ball, "9") +
                       link("boom", "<sphere radius='0.2'/>") + hinge("base", "caster", "0") +
                       hinge("caster", "wheel", "0") + hinge("base", "l1", "5") + hinge("l1", "l2", "1") +
                       hinge("l2", "boom", "-5.75") + "</robot>";
    parameters_.scene.cache_directory.clear();
    parameters_.scene.field.cells = 16;
    parameters_.scene.shell.spacing = 0.05;
    described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters_.scene));
    scene_ = buildDescribed(described_, plan, parameters_.scene, {});
    loop_ = std::make_unique<MonitorLoop>(scene_, described_, parameters_);
  }

  std::vector<std::string> warnings() const {
    return toUncheckedState(1, "base", "", ros::Time(), &loop_->warnings()).warnings;
  }

  static bool begins(const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; }

  MonitorParameters parameters_ = parseParameters({}, "~");
  DescribedScene described_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<MonitorLoop> loop_;
};

TEST_F(OverlapWarnings, AreInTheStateFromTheStart) {
  const std::vector<std::string> said = warnings();
  ASSERT_EQ(said.size(), 2U);
  EXPECT_TRUE(begins(said[0], "1 pair that overlaps at rest is checked: base - boom (")) << said[0];
  EXPECT_NE(said[0].find("\n<disable_collisions link1=\"base\" link2=\"boom\" reason=\"Default\"/>"),
            std::string::npos);
  EXPECT_TRUE(begins(said[1], "1 pair that overlaps at rest is set aside: base - wheel (")) << said[1];
  EXPECT_NE(said[1].find("\n<disable_collisions link1=\"base\" link2=\"wheel\" reason=\"Default\"/>"),
            std::string::npos);
}

TEST_F(OverlapWarnings, FollowTheScene) {
  Scene next = *scene_;
  next.pairs.clear();  // as if a request has left out all of them
  const auto world = firstWorld(std::make_shared<const Scene>(next), described_.scene);
  const std::unique_ptr<LoopChange> change = loop_->prepare(world);
  EXPECT_EQ(warnings().size(), 2U);
  loop_->adopt(*change);
  ASSERT_EQ(warnings().size(), 1U);
  EXPECT_TRUE(begins(warnings()[0], "1 pair that overlaps at rest is set aside: base - wheel ("));
  loop_->adopt(*loop_->prepare(firstWorld(scene_, described_.scene)));
  EXPECT_EQ(warnings().size(), 2U);
}

}  // namespace sdf_ccd::overlap_warnings_test
