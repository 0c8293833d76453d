#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "ros/tf_messages.h"
#include "ros/world/apply_change.h"
#include "ros/world/checked_world.h"
#include "ros/world/describe_scene.h"
#include "scene/name_pair.h"

namespace sdf_ccd::test {

/// A slider with a tool that is fixed to it, and a table from the parameters.
class ChangingSceneCase : public ::testing::Test {
 protected:
  static constexpr double kNow = 100.0;  // [s]

  ChangingSceneCase() : history_("base") {
    parameters_ = parseParameters({}, "~");
    parameters_.urdf =
        R"(<robot name="r"><link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
      <link name="arm"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
      <link name="tool"><collision><geometry><sphere radius="0.1"/></geometry></collision></link><link name="tip"/>
      <joint name="slide" type="prismatic"><parent link="base"/><child link="arm"/><axis xyz="1 0 0"/>
        <limit lower="-5" upper="5" effort="1" velocity="1"/></joint>
      <joint name="fixed" type="fixed"><parent link="arm"/><child link="tool"/></joint>
      <joint name="end" type="fixed"><parent link="tool"/><child link="tip"/></joint></robot>)";
    WorldObject table;
    table.name = "table";
    table.X_frame_B.translation() = Vector3d(50, 0, 0);
    table.shapes = {{Primitive(Box::fromSize({0.6, 0.6, 0.6}))}};
    parameters_.world.push_back(table);
    described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
    files_ = std::make_unique<RequestFiles>(std::vector<std::string>{folder_.string()},
                                            [](const std::string& uri) { return loadLocalResource(uri, {}, ""); });
    begin();
    history_.add(message({stampedTransform("base", "arm", kNow, 2.0), stampedTransform("arm", "tool", kNow, 0.0),
                          stampedTransform("tool", "tip", kNow, 0.5), stampedTransform("base", "belt", kNow, 7.0)}),
                 false);
  }

  /// Starts again, as described.
  void begin() { scene_ = std::make_unique<ChangingScene>(startUpScene(described_, parameters_, described_.scene)); }

  std::vector<std::string> objects() const {
    std::vector<std::string> names;
    for (const auto& [name, object] : scene_->objects()) names.push_back(name);
    return names;
  }

  void apply(const SceneChange& change) { apply(std::vector<SceneChange>{change}); }
  void apply(const std::vector<SceneChange>& changes) {
    ChangingScene next = *scene_;
    ChangeSources sources{history_, *files_, limits_, limits_.triangles, {}};
    for (const SceneChange& change : changes) sdf_ccd::apply(change, sources, next);
    *scene_ = next;
  }
  std::string refusal(const SceneChange& change) {
    return failureOf<std::exception>([&] { apply(change); });
  }
  SceneDescription description() const { return scene_->description(limits_); }
  BodyDescription body(const std::string& name) const {
    for (const BodyDescription& body : description().bodies)
      if (body.name == name) return body;
    return {};
  }
  /// The reason why the plan leaves the pair out; "checked" if it does not.
  std::string reason(const std::string& a, const std::string& b) const {
    for (const PairDecision& pair : planScene(description()).left_out)
      if (namePair(pair.body_a, pair.body_b) == namePair(a, b)) return pair.text;
    return "checked";
  }

  static SceneChange change(int type, const std::string& object = "box") {
    SceneChange made;
    made.operation = static_cast<std::uint8_t>(type);
    made.id = object;
    return made;
  }
  static SceneChange box(const std::string& name = "box") {
    SceneChange made = change(SceneChange::ADD, name);
    made.primitives.resize(1);
    made.primitives[0].type = shape_msgs::SolidPrimitive::BOX;
    made.primitives[0].dimensions = {0.2, 0.4, 0.6};
    made.pose.position.x = 3.0;
    made.pose.orientation.w = 1.0;
    return made;
  }
  static SceneChange rule(int type, const std::string& a, const std::string& b) {
    SceneChange made = change(type, "");
    made.body_a = a;
    made.body_b = b;
    return made;
  }

  const TemporaryDirectory folder_;
  TfHistory history_;
  MonitorParameters parameters_;
  DescribedScene described_;
  RequestLimits limits_;
  std::unique_ptr<RequestFiles> files_;
  std::unique_ptr<ChangingScene> scene_;
};

}  // namespace sdf_ccd::test
