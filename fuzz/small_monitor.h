#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fuzz_input.h"
#include "robot_monitor/changing_scene.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/monitor/queries.h"
#include "ros/tf_messages.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::fuzz {

/// The monitor of a robot with a revolute, a prismatic and a floating joint between two obstacles, with its queries.
class SmallMonitor {
 public:
  SmallMonitor() : parameters_(parseParameters({}, "~")) {
    parameters_.urdf = kUrdf;
    parameters_.scene.cache_directory.clear();
    parameters_.scene.max_error = 0.05;
    for (const double x : {0.6, -0.8}) {
      WorldObject wall;
      wall.name = x > 0.0 ? "front" : "back";
      wall.shapes = {{Primitive(Box::fromSize({0.04, 1.0, 1.0}))}};
      wall.X_frame_B.translation().x() = x;
      parameters_.world.push_back(wall);
    }
    described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters_.scene));
    scene_ = buildDescribed(described_, plan, parameters_.scene, {});
    begin();
  }

  /// Starts again with the transforms of a robot at rest.
  void begin() {
    queries_.reset();
    loop_ = std::make_unique<MonitorLoop>(scene_, described_, parameters_);
    for (const char* link : {"arm", "hand", "ball"}) {
      const char* parent = std::string(link) == "hand" ? "arm" : "base";
      loop_->history().add(test::message({test::stampedTransform(parent, link, kStart, 0.2)}), false);
    }
    queries_ = std::make_unique<Queries>(loop_->world(), described_, parameters_, loop_->history());
  }

  /// An editor that holds the first world; its next one is the second.
  std::unique_ptr<WorldEditor> editor() const {
    auto editor = std::make_unique<WorldEditor>(parameters_.scene);
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters_.scene));
    editor->begin(described_.scene, plan, Scene(*scene_));
    return editor;
  }

  ChangingScene changingScene() const { return ChangingScene(startUpScene(described_, parameters_, described_.scene)); }

  MonitorLoop& loop() { return *loop_; }
  Queries& queries() { return *queries_; }

  static constexpr double kStart = 100.0;  // [s]

 private:
  static constexpr const char* kUrdf = R"(<robot name="small">
    <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
    <link name="arm"><collision><geometry><cylinder radius="0.03" length="0.3"/></geometry></collision></link>
    <link name="hand"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
    <link name="ball"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
    <joint name="swing" type="revolute"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/>
      <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
    <joint name="slide" type="prismatic"><parent link="arm"/><child link="hand"/><axis xyz="1 0 0"/>
      <limit lower="0" upper="1" effort="1" velocity="1"/></joint>
    <joint name="free" type="floating"><parent link="base"/><child link="ball"/></joint></robot>)";

  MonitorParameters parameters_;
  DescribedScene described_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<MonitorLoop> loop_;
  std::unique_ptr<Queries> queries_;
};

/// A name of a link, joint, object or frame, or an unknown one.
inline std::string nameOf(Numbers& numbers) {
  static const std::vector<std::string> kNames = {"base", "arm",   "hand", "ball",  "swing", "slide", "free",
                                                  "",     "world", "/arm", "front", "none",  "a/b"};
  return kNames[numbers.below(kNames.size())];
}

template <class Pose, class Point>
void takePose(Numbers& numbers, Pose& rotation, Point& translation) {
  translation.x = numbers.real();
  translation.y = numbers.real();
  translation.z = numbers.real();
  rotation.x = rotation.y = 0.0;
  rotation.z = numbers.real();
  rotation.w = numbers.below(4) == 0 ? numbers.real() : 1.0;
}

}  // namespace sdf_ccd::fuzz
