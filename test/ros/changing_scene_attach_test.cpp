#include "ros/changing_scene_case.h"

namespace sdf_ccd::changing_scene_attach_test {

using namespace test;

using ChangingSceneAttachTest = ChangingSceneCase;

TEST_F(ChangingSceneAttachTest, AttachesWhereTheObjectIs) {
  apply(box());
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "tip";
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
  SceneChange move = change(SceneChange::MOVE);
  move.pose.orientation.w = 1.0;
  EXPECT_EQ(refusal(move), "box is attached to tip: DETACH it first");

  SceneChange detach = change(SceneChange::DETACH);
  detach.header.frame_id = "belt";
  apply(detach);
  EXPECT_TRUE(body("box").is_world);
  EXPECT_EQ(body("box").frame, "belt");
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 3.0 - 7.0, 1e-9);
  EXPECT_EQ(reason("box", "base"), "checked");
  EXPECT_EQ(refusal(detach), "box is not attached");
}

TEST_F(ChangingSceneAttachTest, AttachesWithOtherShapes) {
  apply(box());
  SceneChange attach = box();
  attach.operation = SceneChange::ATTACH;
  attach.link_name = "tip";
  attach.primitives[0].dimensions = {0.4, 0.4, 0.4};
  attach.pose.position.x = 0.25;
  apply(attach);
  EXPECT_EQ(std::get<Box>(std::get<Primitive>(body("box").geometry[0].shape)).size, Vector3d(0.4, 0.4, 0.4));
  EXPECT_EQ(body("box").frame, "tip");
  EXPECT_EQ(body("box").X_frame_B.translation(), Vector3d(0.25, 0, 0)) << "in the link's frame";
  attach.header.frame_id = "base";
  apply(attach);
  EXPECT_EQ(body("box").frame, "tip");
  EXPECT_NEAR((body("box").X_frame_B.translation() - Vector3d(-2.25, 0, 0)).norm(), 0.0, 1e-9);  // the tip is at 2.5 m
}

/// A pose has one meaning: what leaves the object where it is takes none, not even a zero one.
TEST_F(ChangingSceneAttachTest, AttachWithoutShapesAndDetachTakeNoPose) {
  apply(box());
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "tip";
  attach.pose.orientation.w = 1.0;
  EXPECT_EQ(refusal(attach), "ATTACH without shapes leaves box where it is: MOVE it first, and give no pose");
  SceneChange move = change(SceneChange::MOVE);
  move.pose.position.x = 4.5;
  move.pose.orientation.w = 1.0;
  attach.pose = {};
  apply({move, attach});
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 2.0, 1e-9);
  SceneChange detach = change(SceneChange::DETACH);
  detach.pose.position.x = 1.0;
  EXPECT_EQ(refusal(detach), "DETACH leaves box where it is: MOVE it first, and give no pose");
  apply({change(SceneChange::DETACH), move});
  EXPECT_EQ(body("box").frame, "base");
  EXPECT_EQ(body("box").X_frame_B.translation().x(), 4.5);
}

TEST_F(ChangingSceneAttachTest, AttachesAndDetachesByTransformsOfOneTime) {
  SceneChange added = box();
  added.header.frame_id = "belt";  // 5 m beyond the arm, moving with it; the arm's transforms come later
  added.pose.position.x = 0.0;
  apply(added);
  history_.add(message({stampedTransform("base", "belt", kNow + 0.1, 9.0)}), false);
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "arm";
  apply(attach);
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 5.0, 1e-9);  // 7 - 2, both at kNow
  SceneChange detach = change(SceneChange::DETACH);
  detach.header.frame_id = "belt";
  apply(detach);
  EXPECT_NEAR(body("box").X_frame_B.translation().x(), 0.0, 1e-9);
}

/// Of a live map: voxels in an object are checked again in the version in which the object is gone from there.
TEST_F(ChangingSceneAttachTest, ATileIsJudgedAsItsObjectAsLongAsThatIsThere) {
  BodyDescription tile, other;
  tile.name = "octomap/0_0_0/box";
  other.name = "octomap/0_0_0";
  for (BodyDescription* made : {&tile, &other}) {
    made->frame = "base";
    made->is_world = true;
    made->map = "octomap";
  }
  const auto setTiles = [&] {
    scene_->setTiles({other, tile}, {{tile.name, {"box", scene_->object("box").declared}}}, nullptr);
  };
  const auto isChecked = [&] {
    EXPECT_EQ(body(other.name).name, other.name);
    return !body(tile.name).name.empty();
  };
  apply(box());
  setTiles();
  EXPECT_FALSE(isChecked());
  SceneChange attach = change(SceneChange::ATTACH);
  attach.link_name = "tip";
  apply(attach);
  EXPECT_FALSE(isChecked()) << "it is held where it was";
  apply(change(SceneChange::DETACH));
  EXPECT_FALSE(isChecked());
  apply(rule(SceneChange::ALLOW, "arm", "box"));
  EXPECT_FALSE(isChecked());

  SceneChange move = box();
  move.operation = SceneChange::MOVE;
  apply(move);
  EXPECT_TRUE(isChecked()) << "moved";
  setTiles();
  apply(box());
  EXPECT_TRUE(isChecked()) << "replaced";
  setTiles();
  SceneChange elsewhere = box();
  elsewhere.operation = SceneChange::ATTACH;
  elsewhere.link_name = "tip";
  apply(elsewhere);
  EXPECT_TRUE(isChecked()) << "attached elsewhere";
  setTiles();
  elsewhere.operation = SceneChange::APPEND;
  elsewhere.pose = {};
  apply(elsewhere);
  EXPECT_TRUE(isChecked()) << "has got shapes";
  setTiles();
  apply(change(SceneChange::REMOVE));
  EXPECT_TRUE(isChecked()) << "removed";
  apply(box());
  EXPECT_TRUE(isChecked()) << "another one of its name";
  setTiles();
  apply(change(SceneChange::REMOVE, "*"));
  EXPECT_TRUE(isChecked()) << "all are removed";
}

TEST_F(ChangingSceneAttachTest, WhatMayTouchAllLinksMayNotTouchTheWorld) {
  BodyDescription tile;
  tile.name = "octomap/0_0_0";
  tile.frame = "base";
  tile.is_world = true;
  tile.geometry.push_back({Primitive(Sphere{0.1}), Isometry3d::Identity(), "sphere"});
  scene_->setTiles({tile}, {}, nullptr);
  SceneChange attach = box();
  attach.operation = SceneChange::ATTACH;
  attach.link_name = "tip";
  attach.touch_links = {"*"};
  SceneChange other = box("other");
  other.operation = SceneChange::ATTACH;
  other.link_name = "base";
  apply({attach, other, box("crate")});
  EXPECT_EQ(reason("box", "base"), "attached, and allowed by touch_links");
  EXPECT_EQ(reason("other", "box"), "attached, and allowed by touch_links");
  EXPECT_EQ(reason("other", "base"), "rigidly joined");
  EXPECT_EQ(reason("other", "arm"), "checked");
  for (const char* object : {"table", "crate", "octomap/0_0_0"}) EXPECT_EQ(reason("box", object), "checked") << object;
}

TEST_F(ChangingSceneAttachTest, AttachesWhatIsNotThereYet) {
  SceneChange attach = box();
  attach.operation = SceneChange::ATTACH;
  attach.link_name = "tip";
  apply(attach);
  EXPECT_EQ(body("box").frame, "tip");
  EXPECT_EQ(body("box").X_frame_B.translation(), Vector3d(3, 0, 0));
  attach.link_name = "nowhere";
  EXPECT_EQ(refusal(attach), "the robot has no link nowhere");
  SceneChange nothing = change(SceneChange::ATTACH, "other");
  nothing.link_name = "tip";
  EXPECT_EQ(refusal(nothing), "object other has no shape");
}

}  // namespace sdf_ccd::changing_scene_attach_test
