#include <chrono>
#include <fstream>
#include <limits>

#include "ros/changing_scene_case.h"

namespace sdf_ccd::changing_scene_test {

using namespace test;

using ChangingSceneTest = ChangingSceneCase;

TEST_F(ChangingSceneTest, BeginsAsStartUpLeftIt) {
  EXPECT_EQ(description().bodies.size(), described_.scene.bodies.size());
  EXPECT_EQ(description().allowed.size(), described_.scene.allowed.size());
  EXPECT_EQ(reason("base", "table"), "rigidly joined");
  EXPECT_EQ(reason("arm", "table"), "checked");
}

TEST_F(ChangingSceneTest, AddsMovesAndRemoves) {
  SceneChange added = box();
  added.header.frame_id = "/belt";
  apply(added);
  EXPECT_EQ(body("box").frame, "belt");
  EXPECT_TRUE(body("box").is_world);
  EXPECT_EQ(std::get<Box>(std::get<Primitive>(body("box").geometry[0].shape)).size, Vector3d(0.2, 0.4, 0.6));
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
  EXPECT_EQ(objects(), (std::vector<std::string>{"b", "table"}));
  apply(change(SceneChange::REMOVE, "*"));
  EXPECT_TRUE(objects().empty());
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

TEST_F(ChangingSceneTest, APatternThatNamesNothingIsSaid) {
  ChangeSources sources{history_, *files_, limits_, limits_.triangles, {}};
  ChangingScene next = *scene_;
  sdf_ccd::apply(rule(SceneChange::ALLOW, "zzz", "a*"), sources, next);
  EXPECT_EQ(sources.warnings, std::vector<std::string>{"no body is named zzz, yet"});
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
  EXPECT_EQ(reason("arm", "tool"), "rigidly joined");
  apply(change(SceneChange::FORGET_RULES, ""));
  EXPECT_EQ(description().allowed.size(), described_.scene.allowed.size());
}

TEST_F(ChangingSceneTest, AnObjectOfStartUpStaysJoinedToTheRootWhereItHasMoved) {
  const auto inBase = [&] {
    for (const PairDecision& pair : planScene(description()).left_out)
      if (pair.body_a == "base" && pair.body_b == "table" && pair.rigid)
        return Vector3d(pair.rigid->X_AB.translation());
    return Vector3d(Vector3d::Zero());
  };
  EXPECT_EQ(inBase(), Vector3d(50, 0, 0));
  SceneChange moved = change(SceneChange::MOVE, "table");
  moved.pose.position.x = 3.0;
  moved.pose.orientation.w = 1.0;
  apply(moved);
  EXPECT_EQ(inBase(), Vector3d(3, 0, 0));
  EXPECT_EQ(reason("arm", "table"), "checked");
  moved.header.frame_id = "belt";
  apply(moved);
  EXPECT_EQ(reason("base", "table"), "checked");
}

/// Pairs that are rigidly joined: the last rule of the user decides whether they are watched.
TEST_F(ChangingSceneTest, RulesEndAndBeginTheWatch) {
  const auto isWatched = [&](const std::string& a, const std::string& b) { return reason(a, b) == "rigidly joined"; };
  EXPECT_TRUE(isWatched("arm", "tool") && isWatched("base", "table"));
  apply(rule(SceneChange::ALLOW, "*", "*"));
  EXPECT_EQ(reason("arm", "tool"), "update_scene: * - *");
  EXPECT_EQ(reason("arm", "table"), "update_scene: * - *");
  EXPECT_EQ(reason("base", "table"), "update_scene: * - *");
  apply(rule(SceneChange::CHECK, "arm", "*"));
  EXPECT_TRUE(isWatched("arm", "tool") && !isWatched("base", "table"));
  EXPECT_EQ(reason("arm", "table"), "checked");

  parameters_.pairs.allowed = {{"*", "table"}};
  described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
  begin();
  EXPECT_TRUE(isWatched("arm", "tool") && !isWatched("base", "table"));
  EXPECT_EQ(reason("arm", "table"), "allowed_pairs: * - table");
  apply(rule(SceneChange::CHECK, "*", "table"));
  EXPECT_TRUE(isWatched("base", "table"));
  EXPECT_EQ(reason("arm", "table"), "checked");
  apply(change(SceneChange::FORGET_RULES, ""));
  EXPECT_FALSE(isWatched("base", "table"));
  SceneChange moved = change(SceneChange::MOVE, "table");
  moved.pose.position.x = 3.0;
  moved.pose.orientation.w = 1.0;
  apply(moved);
  EXPECT_EQ(reason("base", "table"), "allowed_pairs: * - table");
  apply(rule(SceneChange::CHECK, "*", "table"));
  EXPECT_TRUE(isWatched("base", "table"));
  EXPECT_EQ(reason("arm", "table"), "checked");
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
  EXPECT_EQ(refusal(bad), "the pose: orientation is not a unit quaternion");
  bad = change(SceneChange::ADD);
  bad.pose.orientation.w = 1.0;
  EXPECT_EQ(refusal(bad), "object box has no shape");
  bad.meshes.resize(1);
  EXPECT_EQ(refusal(bad), "meshes[0] has no triangles");
  bad.meshes[0].vertices.resize(3);
  bad.meshes[0].triangles.resize(1);
  bad.meshes[0].triangles[0].vertex_indices = {{0, 1, 3}};
  EXPECT_EQ(refusal(bad), "meshes[0] has a triangle with vertex index 3, but only 3 vertices");
  EXPECT_EQ(refusal(change(77)), "unknown operation 77, see SceneChange.msg");
  EXPECT_NE(refusal(rule(SceneChange::ALLOW, "", "a")), "");
  for (int i = 0; i < 1000; ++i) apply(rule(SceneChange::ALLOW, "x" + std::to_string(i), "y"));
  EXPECT_NE(refusal(rule(SceneChange::ALLOW, "z", "y")), "");
  apply(rule(SceneChange::CHECK, "y", "x7"));  // replaces another rule of the pair
  limits_.objects = 3;
  apply({box("1"), box("2"), box("3")});
  EXPECT_THROW(description(), std::length_error);
}

/// As in a message that was not filled in, or whose orientation was forgotten.
TEST_F(ChangingSceneTest, AQuaternionOfZerosIsRefusedWithWhatToWrite) {
  const std::string what = "orientation is a quaternion of zeros: write orientation.w: 1";
  for (const int operation : {SceneChange::ADD, SceneChange::MOVE, SceneChange::ATTACH}) {
    SceneChange bad = operation == SceneChange::MOVE ? change(SceneChange::MOVE, "table") : box();
    bad.operation = static_cast<std::uint8_t>(operation);
    bad.link_name = "arm";
    bad.pose.orientation.w = 0.0;
    EXPECT_EQ(refusal(bad), "the pose: " + what);
    bad.pose = {};
    EXPECT_EQ(refusal(bad), "the pose: " + what);
  }
  SceneChange bad = box();
  bad.primitive_poses.resize(1);
  EXPECT_EQ(refusal(bad), "the pose of primitives[0]: " + what);
  bad.primitive_poses[0].orientation.w = 1.0;
  EXPECT_EQ(refusal(bad), "");
  SceneChange mesh = change(SceneChange::ADD);
  mesh.pose.orientation.w = 1.0;
  mesh.mesh_resources = {"package://nothing/a.stl"};
  mesh.mesh_resource_poses.resize(1);
  EXPECT_EQ(refusal(mesh), "the pose of mesh_resources[0]: " + what);
  mesh.mesh_resource_poses.clear();
  mesh.mesh_resource_scales.resize(1);
  EXPECT_EQ(refusal(mesh), "mesh_resources[0]: a component of the scale is zero, not finite or too large");
}

TEST_F(ChangingSceneTest, ListsThatDoNotAgreeAreRefused) {
  SceneChange bad = box();
  bad.primitive_poses.resize(2);
  EXPECT_EQ(refusal(bad), "2 poses for 1 primitives");
  bad.primitive_poses.clear();
  bad.plane_poses.resize(1);
  EXPECT_EQ(refusal(bad), "1 poses for 0 planes");
  bad.plane_poses.clear();
  bad.mesh_poses.resize(1);
  EXPECT_EQ(refusal(bad), "1 poses for 0 meshes");
  bad.mesh_poses.clear();
  bad.mesh_resource_scales.resize(1);
  EXPECT_EQ(refusal(bad), "mesh_resource_scales must be empty, or have one scale per mesh_resource");
}

TEST_F(ChangingSceneTest, AppendsShapesToAnObjectWhereItIs) {
  SceneChange append = change(SceneChange::APPEND);
  append.primitives.resize(1);
  append.primitives[0].type = shape_msgs::SolidPrimitive::SPHERE;
  append.primitives[0].dimensions = {0.5};
  append.primitive_poses.resize(1);
  append.primitive_poses[0].position.z = 2.0;
  append.primitive_poses[0].orientation.w = 1.0;
  EXPECT_EQ(refusal(append), "there is no object box");
  apply({box(), append});
  ASSERT_EQ(body("box").geometry.size(), 2u);
  EXPECT_EQ(std::get<Box>(std::get<Primitive>(body("box").geometry[0].shape)).size, Vector3d(0.2, 0.4, 0.6));
  EXPECT_EQ(std::get<Sphere>(std::get<Primitive>(body("box").geometry[1].shape)).radius, 0.5);
  EXPECT_EQ(body("box").geometry[1].X_BG.translation(), Vector3d(0, 0, 2));
  EXPECT_EQ(body("box").X_frame_B.translation(), Vector3d(3, 0, 0));

  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "tip";
  apply({attach, append});
  ASSERT_EQ(body("box").geometry.size(), 3u);
  EXPECT_EQ(body("box").frame, "tip") << "it stays attached";
  EXPECT_EQ(reason("box", "tool"), "rigidly joined");

  SceneChange bad = append;
  bad.pose.position.x = 1.0;
  EXPECT_EQ(refusal(bad), "APPEND leaves box where it is: MOVE it first, and give no pose");
  bad = change(SceneChange::APPEND);
  EXPECT_EQ(refusal(bad), "object box has no shape");
  bad.octomap_file = (folder_ / "map.bt").string();
  EXPECT_NE(refusal(bad).find("only shape of its object"), std::string::npos);
  limits_.shapes = 3;
  EXPECT_EQ(refusal(append), "box would have more than 3 shapes");
}

/// MoveIt's users give shapes in the header's frame; here they are in the object's.
TEST_F(ChangingSceneTest, ShapesAreAppendedInNoOtherFrame) {
  apply(box());
  SceneChange append = box();
  append.operation = SceneChange::APPEND;
  append.pose = {};
  append.header.frame_id = "belt";
  EXPECT_EQ(
      refusal(append),
      "APPEND leaves box in the frame base, and its shapes are in the object's own: give no frame, instead of belt");
  append.header.frame_id = "/base";
  EXPECT_EQ(refusal(append), "");
  EXPECT_EQ(body("box").geometry.size(), 2u);
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "tool";
  apply(attach);
  EXPECT_NE(refusal(append).find("in the frame tool"), std::string::npos) << refusal(append);
  append.header.frame_id = "tool";
  EXPECT_EQ(refusal(append), "");
  EXPECT_EQ(body("box").frame, "tool");
  EXPECT_EQ(body("box").geometry.size(), 3u);
}

TEST_F(ChangingSceneTest, WhatIsAppendedWrongLeavesAllAsItWas) {
  SceneChange append = box();
  append.operation = SceneChange::APPEND;
  append.pose = {};
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "tool";
  apply({box(), append, append, attach, append});
  ASSERT_EQ(body("box").geometry.size(), 4u);
  EXPECT_EQ(body("box").frame, "tool");
  std::vector<SceneChange> wrong(9, append);
  wrong[0].primitive_poses.resize(1);  // of zeros
  wrong[1].primitive_poses.resize(1);
  wrong[1].primitive_poses[0].orientation.w = 1.0;
  wrong[1].primitive_poses[0].position.y = std::nan("");
  wrong[2].primitives[0].dimensions[2] = std::nan("");
  wrong[3].pose.position.x = std::nan("");
  wrong[4].id = "box/";
  wrong[5].id = "octomap/0_0_0";
  wrong[6].id = "*";
  wrong[7].id = "tool";
  wrong[8].primitive_poses.resize(2);
  for (std::size_t i = 0; i < wrong.size(); ++i) {
    EXPECT_NE(failureOf<std::exception>([&] {
                apply({change(SceneChange::REMOVE, "table"), append, wrong[i]});
              }),
              "")
        << i;
    EXPECT_EQ(body("box").geometry.size(), 4u) << i;
    EXPECT_EQ(body("table").geometry.size(), 1u) << i;
  }
  EXPECT_NE(failureOf<std::exception>([&] { apply({change(SceneChange::REMOVE), append}); }), "");
  apply({append, change(SceneChange::REMOVE), box(), append});  // one after another
  EXPECT_EQ(body("box").geometry.size(), 2u);
  EXPECT_EQ(body("box").frame, "base");
  EXPECT_FALSE(body("box").is_attached);
}

TEST_F(ChangingSceneTest, NamesHoldNoWildcards) {
  for (const char* name : {"*", "bo?", "a*"}) {
    EXPECT_NE(refusal(box(name)).find("must not contain * or ?"), std::string::npos) << name;
    SceneChange attach = box(name);
    attach.operation = SceneChange::ATTACH;
    attach.link_name = "tool";
    EXPECT_NE(refusal(attach).find("must not contain * or ?"), std::string::npos) << name;
  }
  apply({box(), change(SceneChange::REMOVE, "bo?")});
  EXPECT_EQ(objects(), (std::vector<std::string>{"table"}));
  apply(rule(SceneChange::ALLOW, "*", "table"));
}

TEST_F(ChangingSceneTest, NamesOfALiveMapsTilesAreItsOwn) {
  apply(box("octomap/0_0_0"));  // there is no such map
  parameters_.live_map.topic = "/octomap";
  described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
  begin();
  const std::string why = "octomap/0_0_0: names that begin with octomap/ are reserved for the live map's tiles";
  EXPECT_EQ(refusal(box("octomap/0_0_0")), why);
  const std::string world = (folder_ / "w.yaml").string();
  std::ofstream(world) << "world: [{name: octomap/0_0_0, type: sphere, radius: 0.1}]";
  SceneChange load = change(SceneChange::LOAD, "");
  load.file = world;
  EXPECT_EQ(refusal(load), why);
  apply(box("octomap"));
  scene_->setTiles({}, {}, nullptr);
  EXPECT_TRUE(description().has_live_map) << "the next map may have tiles";
}

/// Whatever rules and touch_links requests have made: a map has to wait for none of them to be applied again.
TEST_F(ChangingSceneTest, AMapPaysForNoPatternAnew) {
  const std::string name(240, 'a'), pattern = "*" + std::string(120, 'a') + "b*";
  std::vector<SceneChange> changes;
  for (int i = 0; i < 60; ++i) {
    const std::string number = std::to_string(i);
    changes.push_back(box(name + number));
    changes.push_back(rule(SceneChange::ALLOW, pattern + number, pattern));
    changes.push_back(box(name + "held" + number));
    changes.back().operation = SceneChange::ATTACH;
    changes.back().link_name = "arm";
    changes.back().touch_links.assign(10, pattern + number);
  }
  apply(changes);
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto start = now();
  const std::size_t allowed = description().allowed.size();
  const auto first = now();
  BodyDescription tile;
  tile.name = "octomap/0_0_0";
  tile.map = "octomap";
  tile.frame = "base";
  tile.is_world = true;
  for (int i = 0; i < 5; ++i) {
    ChangingScene next = *scene_;
    next.setTiles({tile}, {}, nullptr);
    EXPECT_EQ(next.description(limits_).allowed.size(), allowed);
  }
  EXPECT_LT(now() - first, first - start) << "for five of them";
}

}  // namespace sdf_ccd::changing_scene_test
