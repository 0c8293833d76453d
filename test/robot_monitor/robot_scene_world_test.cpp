#include <cmath>
#include <type_traits>
#include <utility>

#include <gtest/gtest.h>

#include "oracle/files.h"
#include "oracle/open_shapes.h"
#include "robot_monitor/robot_scene_case.h"

namespace sdf_ccd::robot_scene_world_test {

using namespace test;

TEST(RobotScene, TheRobotMovesAmongObjectsOfTheWorld) {
  const WorldObject wall = {
      "wall", {}, Isometry3d(Eigen::Translation3d(0.8, 0.0, 0.0)), {{Box::fromSize({0.1, 0.2, 0.04})}}};
  const RobotScene scene = RobotScene::parse(kArm, {}, {wall});
  RobotTrajectory drive = swing(0.0, 0.0);
  drive.states[1].X_WR.translation().x() = 1.0;
  const MotionResult result = scene.check(drive);
  ASSERT_EQ(result.verdict, Verdict::kContact);
  ASSERT_EQ(result.find("base", "wall")->contacts.size(), 1U);
  EXPECT_NEAR(result.find("base", "wall")->contacts[0].enter, 0.65, 5e-3);
  RobotState there = drive.states[1];
  there.X_WR.translation().x() = 0.5;
  EXPECT_NEAR(scene.distance(there).distance, 0.15, 1e-6);
  EXPECT_NEAR(scene.distances(there, 0.2).at(0).distance, 0.15, 1e-6);
}

TEST(RobotScene, ObjectsComeMoveAndGo) {
  RobotScene scene = RobotScene::parse(kArm);
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).verdict, Verdict::kClear);
  scene.addObject(kPost);
  EXPECT_EQ(scene.objects(), std::vector<std::string>{"post"});
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).verdict, Verdict::kContact);
  scene.moveObject("post", Isometry3d(Eigen::Translation3d(along(kPostAngle, 1.2))));
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).verdict, Verdict::kClear);
  EXPECT_NEAR(scene.distance({{"shoulder", kPostAngle}, {"elbow", 0.0}}).distance, 1.2 - 0.88 - kRadius, 1e-4);

  // A ball in the hand, which reaches the post: its centre is 1.2 m from the shoulder as well.
  const WorldObject held = ball("held", Vector3d(0.0, 0.0, 0.7), 0.05, "fore");
  scene.addObject(held);
  const MotionResult carried = scene.check(swing(0.0, 1.5));
  EXPECT_EQ(carried.verdict, Verdict::kContact);
  EXPECT_EQ(carried.find("held", "fore"), nullptr);  // it carries it
  ASSERT_EQ(carried.find("held", "post")->contacts.size(), 1U);
  EXPECT_NEAR(carried.find("held", "post")->contacts[0].enter,
              (kPostAngle - 2.0 * std::asin(0.5 * (0.05 + kRadius) / 1.2)) / 1.5, 5e-3);
  scene.addObject(held, {"po*"});
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).find("held", "post"), nullptr);
  EXPECT_EQ(scene.objects(), (std::vector<std::string>{"post", "held"}));
  scene.removeObject("held");
  scene.removeObject("post");
  EXPECT_TRUE(scene.objects().empty());
  EXPECT_EQ(scene.pairs(), (Names{{"base", "fore"}}));
}

TEST(RobotScene, BadObjectsAreRefusedAndNothingChanges) {
  RobotScene scene = RobotScene::parse(kArm, {}, {kPost});
  const auto expectRefused = [&](const WorldObject& object, const std::string& part) {
    const std::string message = messageOf<std::invalid_argument>([&] { scene.addObject(object); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(scene.objects(), std::vector<std::string>{"post"});
    EXPECT_EQ(scene.check(swing(0.0, 1.5)).verdict, Verdict::kContact);
  };
  expectRefused(ball("", Vector3d::Zero(), 0.1), "must not be empty");
  expectRefused(ball("p*", Vector3d::Zero(), 0.1), "wildcards");
  expectRefused(ball("fore", Vector3d::Zero(), 0.1), "link of this name");
  expectRefused(ball("tool", Vector3d::Zero(), 0.1, "hand"), "no link \"hand\"");
  expectRefused({"tool", {}, Isometry3d::Identity(), {}}, "no shape");
  expectRefused(ball("tool", Vector3d(std::nan(""), 0.0, 0.0), 0.1), "pose");
  WorldObject flat = kPost;
  flat.X_frame_B.linear().setZero();
  expectRefused(flat, "orthonormal");
  expectRefused(ball("post", Vector3d::Zero(), -0.1), "-0.2");
  expectRefused({"post", {}, Isometry3d::Identity(), {{MeshObject{"none.stl", Vector3d::Ones()}}}}, "none.stl");
  EXPECT_THROW(scene.moveObject("tool", Isometry3d::Identity()), std::invalid_argument);
  EXPECT_THROW(scene.removeObject("tool"), std::invalid_argument);
  EXPECT_THROW(RobotScene::parse(kArm, {}, {kPost, kPost}), std::invalid_argument);
  EXPECT_THROW(RobotScene::parse(kArm, {}, {ball("tool", Vector3d::Zero(), 0.1, "hand")}), std::invalid_argument);
  const RobotScene bad = RobotScene::parse(kArm, {}, {ball("post", Vector3d::Zero(), -0.1)});
  EXPECT_EQ(bad.check(swing(0.0, 1.5)).verdict, Verdict::kNotChecked);
  EXPECT_TRUE(hasLine(bad.warnings(), "post"));
}

TEST(RobotScene, MovesButIsNotCopied) {
  static_assert(!std::is_copy_constructible_v<RobotScene> && std::is_nothrow_move_assignable_v<RobotScene>);
  RobotScene scene = RobotScene::parse(kArm);
  RobotScene other = RobotScene::parse(kArm, {}, {kPost});
  std::swap(scene, other);
  EXPECT_EQ(scene.check(swing(0.0, 1.5)).verdict, Verdict::kContact);
  EXPECT_EQ(other.check(swing(0.0, 1.5)).verdict, Verdict::kClear);
}

TEST(RobotScene, ABaseThatFloatsIsWhereItsPoseIs) {
  std::string drone = kArm;
  drone.insert(drone.find("<link"),
               "<link name='world'/><joint name='air' type='floating'><parent link='world'/>"
               "<child link='base'/></joint>");
  RobotScene scene = RobotScene::parse(drone, {}, {ball("lamp", Vector3d(2.0, 0.0, 0.0), 0.1)});
  const JointPositions folded = {{"shoulder", 0.0}, {"elbow", 0.0}};
  const BodyDistance unknown = scene.distance(folded);
  EXPECT_EQ(unknown.verdict, Verdict::kNotChecked);
  EXPECT_NE(unknown.reason.find("air"), std::string::npos) << unknown.reason;
  scene.setJoints({}, {{"air", Isometry3d(Eigen::Translation3d(1.5, 0.0, 0.0))}});
  EXPECT_NEAR(scene.distances(folded, 0.35).at(0).distance, 0.3, 1e-6);  // from the side of the base
  RobotTrajectory flight;
  flight.times = {0.0, 1.0};
  for (const double x : {0.0, 4.0})
    flight.states.push_back({Isometry3d::Identity(), folded, {{"air", Isometry3d(Eigen::Translation3d(x, 0.0, 0.0))}}});
  const MotionResult result = scene.check(flight);
  EXPECT_EQ(result.verdict, Verdict::kContact);
  ASSERT_EQ(result.find("base", "lamp")->contacts.size(), 1U);
  EXPECT_NEAR(result.find("base", "lamp")->contacts[0].enter, 1.8 / 4.0, 5e-3);
}

TEST(RobotScene, WhatMayBeInsideAnOpeningIsNeverHidden) {
  // The whole arm is in a bin without a lid, far from its walls; the post is much nearer.
  const WorldObject bin = {"bin", {}, Isometry3d::Identity(), {{std::make_shared<const TriangleMesh>(binMesh(2.0))}}};
  RobotSceneOptions options;
  options.measure_contacts = false;
  const RobotScene scene = RobotScene::parse(kArm, {}, {kPost, bin}, options);
  const JointPositions joints = {{"shoulder", kPostAngle - 0.3}, {"elbow", 0.0}};
  EXPECT_EQ(scene.check(swing(0.0, 0.1)).find("fore", "bin")->verdict, Verdict::kUncertain);
  const BodyDistance nearest = scene.distance(joints);
  EXPECT_EQ(nearest.verdict, Verdict::kUncertain);
  EXPECT_EQ(nearest.body_b, "bin");
  EXPECT_LE(nearest.distance - nearest.error, 0.0);
  std::vector<std::string> uncertain;
  for (const BodyDistance& near : scene.distances(joints, 0.2)) {
    if (near.verdict == Verdict::kUncertain) uncertain.push_back(near.body_a + " " + near.body_b);
    EXPECT_LE(near.distance - near.error, 0.2);
  }
  EXPECT_EQ(uncertain.size(), 3U);  // all links
}

TEST(RobotScene, ReadsAnOctoMap) {
  // A voxel of 0.25 m in the corner above the origin: fifteen levels of one child, then the leaf.
  std::string map = "# Octomap OcTree binary file\nid OcTree\nsize 17\nres 0.25\ndata\n";
  map += std::string("\0\xc0", 2);
  for (int level = 0; level < 14; ++level) map += std::string("\x03\0", 2);
  map += std::string("\x02\0", 2);
  const TemporaryDirectory folder;
  writeText(folder / "map.bt", map);
  WorldObject room = {"room", {}, Isometry3d(Eigen::Translation3d(0.3, -0.125, 0.0)), {}};
  room.shapes.push_back({OctomapObject{(folder / "map.bt").string()}});
  const RobotScene scene = RobotScene::parse(kArm, {}, {room});
  if (!scene.warnings().empty() && scene.warnings()[0].find("has no OctoMap") != std::string::npos) GTEST_SKIP();
  EXPECT_TRUE(scene.warnings().empty()) << scene.warnings()[0];
  // The upper link's side passes the voxel's upper edge, at (0.3, 0.25).
  const double reach = std::hypot(0.3, 0.25), edge = std::atan2(0.3, 0.25) - std::asin(0.025 / reach);
  EXPECT_LT(reach, 0.45);
  EXPECT_EQ(scene.check(swing(0.0, edge - 1e-3)).find("upper", "room")->verdict, Verdict::kClear);
  EXPECT_EQ(scene.check(swing(0.0, edge + 1e-3)).find("upper", "room")->verdict, Verdict::kContact);
  EXPECT_NEAR(scene.distances({{"shoulder", 0.0}, {"elbow", 0.0}}, 0.3).at(0).distance, 0.2, 1e-6);  // the base

  room.shapes.push_back({Sphere{0.1}});
  EXPECT_TRUE(hasLine(RobotScene::parse(kArm, {}, {room}).warnings(), "cannot have other shapes"));
  room.shapes = {{OctomapObject{"none.bt"}}};
  const RobotScene missing = RobotScene::parse(kArm, {}, {room});
  EXPECT_TRUE(hasLine(missing.warnings(), "none.bt"));
  EXPECT_EQ(missing.check(swing(0.0, 0.1)).verdict, Verdict::kNotChecked);
}

}  // namespace sdf_ccd::robot_scene_world_test
