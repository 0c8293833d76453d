#include "ros/world/changing_scene.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/mesh_bytes.h"
#include "oracle/shapes.h"
#include "ros/parameters/moveit_scene.h"
#include "ros/tf_messages.h"

namespace sdf_ccd {
namespace {

using namespace test;

constexpr double kNow = 100.0;  // [s]

/// A slider with a tool that is fixed to it, and a table from the parameters.
class ChangingSceneTest : public ::testing::Test {
 protected:
  ChangingSceneTest() : history_("base") {
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
    table.shapes = {{Primitive(Box{Vector3d(0.3, 0.3, 0.3)})}};
    parameters_.world.push_back(table);
    described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
    files_ = std::make_unique<RequestFiles>(std::vector<std::string>{folder_.string()},
                                            [](const std::string& uri) { return loadLocalResource(uri, {}, ""); });
    scene_ = std::make_unique<ChangingScene>(described_, parameters_.pairs, described_.scene);
    history_.add(message({stampedTransform("base", "arm", kNow, 2.0), stampedTransform("arm", "tool", kNow, 0.0),
                          stampedTransform("tool", "tip", kNow, 0.5), stampedTransform("base", "belt", kNow, 7.0)}),
                 false);
  }

  void apply(const SceneChange& change) { apply(std::vector<SceneChange>{change}); }
  void apply(const std::vector<SceneChange>& changes) {
    ChangingScene next = *scene_;
    ChangeSources sources{history_, *files_, limits_, limits_.triangles, {}};
    for (const SceneChange& change : changes) next.apply(change, sources);
    *scene_ = next;
  }
  std::string refusal(const SceneChange& change) {
    return test::failureOf<std::exception>([&] { apply(change); });
  }
  SceneDescription description() const { return scene_->description(limits_); }
  BodyDescription body(const std::string& name) const {
    for (const BodyDescription& body : description().bodies)
      if (body.name == name) return body;
    return {};
  }
  /// The reason why the pair is left out; "checked" if it is not.
  std::string reason(const std::string& a, const std::string& b) const {
    for (const AllowedPair& pair : description().allowed)
      if (namePair(pair.body_a, pair.body_b) == namePair(a, b)) return pair.reason;
    return "checked";
  }

  static SceneChange change(int type, const std::string& object = "box") {
    SceneChange made;
    made.type = static_cast<std::uint8_t>(type);
    made.object = object;
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

  const test::TemporaryDirectory folder_;
  TfHistory history_;
  MonitorParameters parameters_;
  DescribedScene described_;
  RequestLimits limits_;
  std::unique_ptr<RequestFiles> files_;
  std::unique_ptr<ChangingScene> scene_;
};

TEST_F(ChangingSceneTest, BeginsAsStartUpLeftIt) {
  EXPECT_EQ(description().bodies.size(), described_.scene.bodies.size());
  EXPECT_EQ(description().allowed.size(), described_.scene.allowed.size());
  EXPECT_EQ(reason("arm", "table"), "out of reach");
  EXPECT_EQ(scene_->unreachable(description()).size(), described_.unreachable.size());
}

TEST_F(ChangingSceneTest, AddsMovesAndRemoves) {
  SceneChange added = box();
  added.header.frame_id = "/belt";
  apply(added);
  EXPECT_EQ(body("box").frame, "belt");
  EXPECT_TRUE(body("box").is_world);
  EXPECT_EQ(std::get<Box>(std::get<Primitive>(body("box").geometry[0].shape)).half_size, Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(body("box").X_frame_B.translation(), Vector3d(3, 0, 0));
  EXPECT_EQ(reason("arm", "box"), "checked");
  SceneChange moved = change(SceneChange::MOVE);
  moved.pose.position.y = 1.0;
  moved.pose.orientation.w = 1.0;
  apply(moved);
  EXPECT_EQ(body("box").frame, "belt");
  EXPECT_EQ(body("box").X_frame_B.translation(), Vector3d(0, 1, 0));
  apply(change(SceneChange::REMOVE));
  EXPECT_EQ(body("box").name, "");
  EXPECT_EQ(refusal(change(SceneChange::REMOVE)), "there is no object box");
  apply({box("a1"), box("a2"), box("b"), change(SceneChange::REMOVE, "a*")});
  EXPECT_EQ(scene_->objects(), (std::vector<std::string>{"b", "table"}));
  apply(change(SceneChange::CLEAR));
  EXPECT_TRUE(scene_->objects().empty());
}

TEST_F(ChangingSceneTest, AConeStandsOnItsBase) {
  SceneChange cone = box();
  cone.primitives[0].type = shape_msgs::SolidPrimitive::CONE;
  cone.primitives[0].dimensions = {0.4, 0.1};
  cone.primitives[0].dimensions[shape_msgs::SolidPrimitive::CONE_HEIGHT] = 0.4;
  apply(cone);
  const auto mesh = std::get<std::shared_ptr<const TriangleMesh>>(body("box").geometry[0].shape);
  EXPECT_NEAR(signedVolume(*mesh), M_PI * 0.01 * 0.4 / 3.0, 1e-5);
  const AlignedBox3d bounds = boundingBox(*mesh);
  EXPECT_TRUE(bounds.sizes().isApprox(Vector3d(0.2, 0.2, 0.4), 1e-3)) << bounds.sizes().transpose();
  for (const Vector3d& p : mesh->vertices) EXPECT_TRUE(p.z() < 0.0 || p.head<2>().isZero(0.0)) << p.transpose();
}

TEST_F(ChangingSceneTest, AttachesWhereTheObjectIs) {
  apply(box());
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link = "tip";
  apply(attach);
  EXPECT_EQ(body("box").frame, "tip");
  EXPECT_FALSE(body("box").is_world);
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 0.5, 1e-9);  // the tip is at 2.5, the box at 3
  // Links that cannot move relative to the tip are not checked; the base and the table are.
  EXPECT_EQ(reason("box", "tool"), "rigidly joined");
  EXPECT_EQ(reason("box", "arm"), "rigidly joined");
  EXPECT_EQ(reason("box", "base"), "checked");
  EXPECT_EQ(reason("box", "table"), "checked");
  attach.touch_links = {"ba*", "table"};
  apply(attach);
  EXPECT_EQ(reason("box", "base"), "attached, and allowed by touch_links");
  EXPECT_EQ(reason("box", "table"), "checked") << "it is neither a link nor attached";
  EXPECT_NE(refusal(change(SceneChange::MOVE)).find("attached to tip"), std::string::npos);

  SceneChange detach = change(SceneChange::DETACH);
  detach.header.frame_id = "belt";
  apply(detach);
  EXPECT_TRUE(body("box").is_world);
  EXPECT_EQ(body("box").frame, "belt");
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 3.0 - 7.0, 1e-9);
  EXPECT_EQ(reason("box", "base"), "checked");
  EXPECT_EQ(refusal(detach), "box is not attached");
}

TEST_F(ChangingSceneTest, APatternThatNamesNothingIsSaid) {
  ChangeSources sources{history_, *files_, limits_, limits_.triangles, {}};
  ChangingScene next = *scene_;
  next.apply(rule(SceneChange::ALLOW, "zzz", "a*"), sources);
  EXPECT_EQ(sources.warnings, std::vector<std::string>{"no body is named zzz, yet"});
}

TEST_F(ChangingSceneTest, AttachesWithOtherShapes) {
  apply(box());
  SceneChange attach = box();
  attach.type = SceneChange::ATTACH;
  attach.link = "tip";
  attach.primitives[0].dimensions = {0.4, 0.4, 0.4};
  attach.pose = geometry_msgs::Pose();
  const Isometry3d before = body("box").X_frame_B;
  apply(attach);
  EXPECT_EQ(std::get<Box>(std::get<Primitive>(body("box").geometry[0].shape)).half_size, Vector3d(0.2, 0.2, 0.2));
  EXPECT_EQ(body("box").frame, "tip");
  // Without a pose it stays where it was: the tip is at 2.5 m.
  EXPECT_NEAR((body("box").X_frame_B.translation() - (before.translation() - Vector3d(2.5, 0, 0))).norm(), 0.0, 1e-9);
}

TEST_F(ChangingSceneTest, AttachesAndDetachesByTransformsOfOneTime) {
  SceneChange added = box();
  added.header.frame_id = "belt";  // 5 m beyond the arm, moving with it; the arm's transforms come later
  added.pose.position.x = 0.0;
  apply(added);
  history_.add(message({stampedTransform("base", "belt", kNow + 0.1, 9.0)}), false);
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link = "arm";
  apply(attach);
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 5.0, 1e-9);  // 7 - 2, both at kNow
  SceneChange detach = change(SceneChange::DETACH);
  detach.header.frame_id = "belt";
  apply(detach);
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 0.0, 1e-9);
}

TEST_F(ChangingSceneTest, WhatMayTouchAllLinksMayNotTouchTheWorld) {
  BodyDescription tile;
  tile.name = "octomap/0_0_0";
  tile.frame = "base";
  tile.is_world = true;
  scene_->setTiles({tile});
  SceneChange attach = box();
  attach.type = SceneChange::ATTACH;
  attach.link = "tip";
  attach.touch_links = {"*"};
  SceneChange other = box("other");
  other.type = SceneChange::ATTACH;
  other.link = "base";
  apply({attach, other, box("crate")});
  EXPECT_EQ(reason("box", "base"), "attached, and allowed by touch_links");
  EXPECT_EQ(reason("other", "box"), "attached, and allowed by touch_links");
  for (const char* object : {"table", "crate", "octomap/0_0_0"}) EXPECT_EQ(reason("box", object), "checked") << object;
}

TEST_F(ChangingSceneTest, AttachesWhatIsNotThereYet) {
  SceneChange attach = box();
  attach.type = SceneChange::ATTACH;
  attach.link = "tip";
  apply(attach);
  EXPECT_EQ(body("box").frame, "tip");
  EXPECT_EQ(body("box").X_frame_B.translation(), Vector3d(3, 0, 0));
  attach.link = "nowhere";
  EXPECT_EQ(refusal(attach), "the robot has no link nowhere");
}

TEST_F(ChangingSceneTest, RulesOfLaterCallsWin) {
  apply({box("one"), box("two")});
  apply(rule(SceneChange::ALLOW, "arm", "*"));
  EXPECT_EQ(reason("arm", "one"), "update_scene: arm - *");
  EXPECT_EQ(reason("tool", "one"), "checked");
  apply(rule(SceneChange::CHECK, "two", "arm"));
  EXPECT_EQ(reason("arm", "one"), "update_scene: arm - *");
  EXPECT_EQ(reason("arm", "two"), "checked");
  apply(rule(SceneChange::CHECK, "*", "*"));
  EXPECT_EQ(reason("arm", "one"), "checked");
  EXPECT_EQ(reason("arm", "tool"), "rigidly joined");  // they can never come closer
  apply(change(SceneChange::FORGET_RULES, ""));
  EXPECT_EQ(description().allowed.size(), described_.scene.allowed.size() + 2);  // the base and the two objects on it
}

TEST_F(ChangingSceneTest, AnObjectThatWasOutOfReachIsCheckedWhereItHasMoved) {
  SceneChange moved = change(SceneChange::MOVE, "table");
  moved.pose.position.x = 3.0;
  moved.pose.orientation.w = 1.0;
  apply(moved);
  EXPECT_EQ(reason("arm", "table"), "checked");
  EXPECT_LT(scene_->unreachable(description()).size(), described_.unreachable.size());
}

TEST_F(ChangingSceneTest, RefusesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SceneChange bad = box("arm");
  EXPECT_EQ(refusal(bad), "arm is a link of the robot");
  EXPECT_NE(refusal(box("")), "");
  EXPECT_NE(refusal(box(std::string(300, 'x'))), "");
  EXPECT_NE(refusal(box("a\nb")), "");
  bad = box();
  bad.primitives[0].dimensions[1] = nan;
  EXPECT_NE(refusal(bad), "");
  bad.primitives[0].dimensions = {1, 1, -1};
  EXPECT_NE(refusal(bad), "");
  bad.primitives[0].dimensions = {1, 1};
  EXPECT_EQ(refusal(bad), "primitives[0] has 2 dimensions instead of 3");
  bad.primitives[0].type = 5;
  EXPECT_NE(refusal(bad), "");
  bad = box();
  bad.pose.position.z = nan;
  EXPECT_NE(refusal(bad), "");
  bad = box();
  bad.pose.orientation.w = 0.5;
  EXPECT_EQ(refusal(bad), "the pose has an orientation that is not a unit quaternion");
  bad = change(SceneChange::ADD);
  EXPECT_EQ(refusal(bad), "object box has no shape");
  bad.meshes.resize(1);
  EXPECT_EQ(refusal(bad), "meshes[0] has no triangles");
  bad.meshes[0].vertices.resize(3);
  bad.meshes[0].triangles.resize(1);
  bad.meshes[0].triangles[0].vertex_indices = {{0, 1, 3}};
  EXPECT_EQ(refusal(bad), "meshes[0] has a triangle with vertex index 3, but only 3 vertices");
  EXPECT_EQ(refusal(change(77)), "unknown type 77, see SceneChange.msg");
  EXPECT_NE(refusal(rule(SceneChange::ALLOW, "", "a")), "");
  for (int i = 0; i < 1000; ++i) apply(rule(SceneChange::ALLOW, "x" + std::to_string(i), "y"));
  EXPECT_NE(refusal(rule(SceneChange::ALLOW, "z", "y")), "");
  apply(rule(SceneChange::CHECK, "y", "x7"));  // replaces another rule of the pair
  limits_.objects = 3;
  apply({box("1"), box("2"), box("3")});
  EXPECT_THROW(description(), std::length_error);
}

TEST_F(ChangingSceneTest, TrianglesOfMeshFilesCountAgainstTheLimit) {
  test::writeText(folder_ / "ball.off", test::off(test::icosphere(0.1, 1)));  // 80 triangles
  SceneChange ball = change(SceneChange::ADD, "ball");
  ball.mesh_resources = {(folder_ / "ball.off").string()};
  limits_.triangles = 160;
  SceneChange other = ball;
  other.object = "other";
  apply({ball, other});
  limits_.triangles = 159;
  const std::string refused = failureOf<std::exception>([&] { apply({ball, other}); });
  EXPECT_NE(refused.find("more triangles than one call may hold"), std::string::npos) << refused;
}

TEST_F(ChangingSceneTest, NamesWithBlanksAtTheirEndsAreNeitherTakenNorSaved) {
  for (const char* name : {" a", "a ", " "}) {
    EXPECT_EQ(refusal(box(name)).find("object '" + std::string(name) + "': a name must not be empty, begin or end"),
              0u);
    SceneChange attach = box(name);
    attach.type = SceneChange::ATTACH;
    attach.link = "tool";
    EXPECT_NE(refusal(attach), "") << name;
  }
  EXPECT_EQ(refusal(box("a b")), "");
  // A world file may have named it so; when read back, it would be another object.
  BodyDescription trailing = body("a b");
  trailing.name = "a ";
  scene_->set(trailing);
  ChangeSources sources{history_, *files_, limits_, limits_.triangles, {}};
  EXPECT_NE(test::failureOf<std::invalid_argument>([&] { scene_->text(sources, sources.warnings); }).find("'a '"),
            std::string::npos);
}

TEST_F(ChangingSceneTest, NamesHoldNoWildcards) {
  for (const char* name : {"*", "bo?", "a*"}) {
    EXPECT_NE(refusal(box(name)).find("must not contain * or ?"), std::string::npos) << name;
    SceneChange attach = box(name);
    attach.type = SceneChange::ATTACH;
    attach.link = "tool";
    EXPECT_NE(refusal(attach).find("must not contain * or ?"), std::string::npos) << name;
  }
  apply({box(), change(SceneChange::REMOVE, "bo?")});
  EXPECT_EQ(scene_->objects(), (std::vector<std::string>{"table"}));
  apply(rule(SceneChange::ALLOW, "*", "table"));
}

TEST_F(ChangingSceneTest, NamesOfALiveMapsTilesAreItsOwn) {
  apply(box("octomap/0_0_0"));  // there is no such map
  parameters_.live_map.topic = "/octomap";
  described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
  scene_ = std::make_unique<ChangingScene>(described_, parameters_.pairs, described_.scene);
  const std::string why = "octomap/0_0_0: names that begin with octomap/ are reserved for the live map's tiles";
  EXPECT_EQ(refusal(box("octomap/0_0_0")), why);
  const std::string world = (folder_ / "w.yaml").string();
  std::ofstream(world) << "world: [{name: octomap/0_0_0, type: sphere, radius: 0.1}]";
  SceneChange load = change(SceneChange::LOAD, "");
  load.file = world;
  EXPECT_EQ(refusal(load), why);
  apply(box("octomap"));
  scene_->setTiles({});
  EXPECT_TRUE(description().has_live_map) << "the next map may have tiles";
}

TEST_F(ChangingSceneTest, ReadsNoFilesButThoseBelowTheRoots) {
  SceneChange bad = change(SceneChange::ADD);
  for (const std::string& uri : {std::string("file:///etc/passwd"), std::string("/etc/passwd"),
                                 folder_.string() + "/../passwd", std::string("mesh.stl")}) {
    bad.mesh_resources = {uri};
    EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos) << refusal(bad);
  }
  std::filesystem::create_symlink("/etc", folder_ / "link");
  bad.mesh_resources = {(folder_ / "link/passwd").string()};
  EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos);
  bad = change(SceneChange::LOAD, "");
  bad.file = "/etc/world.yaml";
  EXPECT_NE(refusal(bad).find("resource_roots"), std::string::npos);
  std::ofstream(folder_ / "tetra.off")
      << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n";
  SceneChange good = change(SceneChange::ADD);
  good.mesh_resources = {"file://" + (folder_ / "tetra.off").string()};
  EXPECT_EQ(refusal(good), "");
}

TEST_F(ChangingSceneTest, ARootMayComeLater) {
  const std::filesystem::path later = folder_ / "later";
  const RequestFiles files({later.string()}, [](const std::string&) { return Resource(); });
  const std::string file = (later / "a.off").string();
  EXPECT_THROW(files.path(file), std::runtime_error);
  std::filesystem::create_directory(later);
  EXPECT_EQ(files.path(file), std::filesystem::canonical(later).string() + "/a.off");
}

TEST_F(ChangingSceneTest, WhatIsWrittenIsReadAgain) {
  SceneChange all = box("all");
  all.primitives.resize(3);
  all.primitives[1].type = shape_msgs::SolidPrimitive::SPHERE;
  all.primitives[1].dimensions = {0.1};
  all.primitives[2].type = shape_msgs::SolidPrimitive::CYLINDER;
  all.primitives[2].dimensions = {0.5, 0.1};
  all.planes.resize(1);
  all.planes[0].coef = {{0, 0, 2, 1}};
  all.meshes.resize(1);
  all.meshes[0].vertices.resize(3);
  all.meshes[0].vertices[1].x = all.meshes[0].vertices[2].y = 1.0 / 3.0;
  all.meshes[0].triangles.resize(1);
  all.meshes[0].triangles[0].vertex_indices = {{0, 1, 2}};
  all.header.frame_id = "belt";
  apply(all);
  ChangeSources sources{history_, *files_, limits_, limits_.triangles, {}};
  std::ofstream(folder_ / "world.scene") << scene_->text(sources, sources.warnings);
  SceneChange load = change(SceneChange::LOAD, "");
  load.file = (folder_ / "world.scene").string();
  const BodyDescription before = body("all");
  apply({change(SceneChange::CLEAR, ""), load});
  const BodyDescription after = body("all");
  EXPECT_EQ(after.frame, "base");
  EXPECT_NEAR((after.X_frame_B.translation() - Vector3d(10, 0, 0)).norm(), 0.0, 1e-12);
  ASSERT_EQ(after.geometry.size(), before.geometry.size());
  for (std::size_t i = 0; i < after.geometry.size(); ++i)
    ASSERT_EQ(after.geometry[i].shape.index(), before.geometry[i].shape.index());
  const auto& plane = std::get<HalfSpace>(std::get<Primitive>(after.geometry[3].shape));
  EXPECT_EQ(plane.offset, -0.5);
  const auto& mesh = *std::get<std::shared_ptr<const TriangleMesh>>(after.geometry[4].shape);
  EXPECT_EQ(mesh.vertices[1].x(), 1.0 / 3.0);
  EXPECT_EQ(scene_->objects(), (std::vector<std::string>{"all", "table"}));
}

}  // namespace
}  // namespace sdf_ccd
