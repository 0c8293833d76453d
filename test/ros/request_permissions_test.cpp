#include "robot_monitor/request_permissions.h"

#include "ros/changing_scene_case.h"

namespace sdf_ccd::request_permissions_test {

using namespace test;

class RequestPermissionsTest : public ChangingSceneCase {
 protected:
  void permit(const std::vector<std::string>& kinds, const std::vector<std::string>& protected_bodies = {}) {
    parameters_.requests = permissionsOf(kinds);
    parameters_.requests.protected_bodies = protected_bodies;
    begin();
  }
  void expectRefused(const SceneChange& change, const std::string& parameter) {
    EXPECT_NE(refusal(change).find(parameter), std::string::npos) << refusal(change);
  }
  static SceneChange attach(const std::string& name, std::vector<std::string> touch_links = {}) {
    SceneChange made = change(SceneChange::ATTACH, name);
    made.link_name = "arm";
    made.touch_links = std::move(touch_links);
    return made;
  }
};

TEST_F(RequestPermissionsTest, EachKindOfChangeNeedsItsPermission) {
  SceneChange move = change(SceneChange::MOVE, "table"), append = box("table");
  move.pose.orientation.w = 1.0;
  append.operation = SceneChange::APPEND;
  append.pose = {};
  const std::vector<std::pair<std::string, SceneChange>> kinds{{"add", box()},
                                                               {"move", append},
                                                               {"move", move},
                                                               {"move", box("table")},  // replaces it
                                                               {"attach", attach("table")},
                                                               {"rules", rule(SceneChange::ALLOW, "table", "arm")},
                                                               {"rules", rule(SceneChange::CHECK, "table", "arm")},
                                                               {"rules", change(SceneChange::FORGET_RULES)},
                                                               {"clear", change(SceneChange::REMOVE, "table")},
                                                               {"clear", change(SceneChange::REMOVE, "*")}};
  const std::vector<std::string> all{"add", "move", "attach", "rules", "clear"};
  for (const auto& [kind, wanted] : kinds) {
    std::vector<std::string> others = all;
    others.erase(std::find(others.begin(), others.end(), kind));
    permit(others);
    expectRefused(wanted, "requests/allow does not hold " + kind);
    permit({kind});
    EXPECT_EQ(refusal(wanted), "") << kind;
  }
}

TEST_F(RequestPermissionsTest, ToAttachOrDetachNeitherAddsNorMoves) {
  permit({"attach"});
  SceneChange speck = box("table");
  speck.operation = SceneChange::ATTACH;
  speck.link_name = "arm";
  expectRefused(speck, "requests/allow does not hold move");
  speck.id = "box";
  expectRefused(speck, "requests/allow does not hold add");
  apply(attach("table"));
  SceneChange moved = change(SceneChange::DETACH, "table");
  moved.header.frame_id = "belt";
  expectRefused(moved, "requests/allow does not hold move");
  EXPECT_EQ(refusal(change(SceneChange::DETACH, "table")), "");
}

/// Else a request that may only attach could add objects, or replace a wall by a speck, and detach it again.
TEST_F(RequestPermissionsTest, WhatAttachAddsOrReplacesNeedsThatPermissionToo) {
  const auto attached = [](const std::string& name) {
    SceneChange made = box(name);
    made.operation = SceneChange::ATTACH;
    made.link_name = "arm";
    return made;
  };
  permit({"attach"});
  expectRefused(attached("box"), "requests/allow does not hold add");
  expectRefused(attached("table"), "requests/allow does not hold move");
  permit({"attach", "add"});
  EXPECT_EQ(refusal(attached("box")), "");
  expectRefused(attached("table"), "requests/allow does not hold move");
  permit({"attach", "move"});
  EXPECT_EQ(refusal(attached("table")), "");
}

TEST_F(RequestPermissionsTest, ByDefaultAllButLimitsIsAllowed) {
  EXPECT_EQ(refusal(box("table")), "");
  EXPECT_EQ(refusal(change(SceneChange::REMOVE, "*")), "");
  EXPECT_TRUE(parameters_.requests.reset);
  EXPECT_FALSE(parameters_.requests.limits);
}

TEST_F(RequestPermissionsTest, WhatIsProtectedStays) {
  permit({"add", "move", "attach", "rules", "clear"}, {"ta*", "base"});
  apply(box());
  for (const SceneChange& wanted :
       {change(SceneChange::MOVE, "table"), box("table"), change(SceneChange::REMOVE, "table"),
        change(SceneChange::REMOVE, "*"), change(SceneChange::APPEND, "table"), attach("table"), attach("box", {"*"}),
        attach("box", {"base"}), rule(SceneChange::ALLOW, "table", "arm"), rule(SceneChange::ALLOW, "box", "*")})
    expectRefused(wanted, "requests/protected");
  EXPECT_EQ(refusal(rule(SceneChange::CHECK, "table", "*")), "");
  EXPECT_EQ(refusal(rule(SceneChange::ALLOW, "box", "arm")), "");
  EXPECT_EQ(refusal(attach("box", {"tool"})), "");
}

TEST_F(RequestPermissionsTest, ARuleDoesNotReachAProtectedBodyThatComesLater) {
  permit({"add", "rules"}, {"box*"});
  apply(rule(SceneChange::ALLOW, "b?x*", "arm"));
  apply({box("box"), box("bax")});
  EXPECT_EQ(reason("box", "arm"), "checked");
  EXPECT_EQ(reason("bax", "arm"), "update_scene: b?x* - arm");
  EXPECT_EQ(allowedByRequests(description()), 1u);
}

/// Else who may add an object, and allow it to touch, could take any part of a protected map from the checks.
TEST_F(RequestPermissionsTest, VoxelsOfAProtectedMapAreNotJudgedAsAnObjectOfRequests) {
  BodyDescription of_box, of_table;
  of_box.name = "octomap/0_0_0/box";
  of_table.name = "octomap/0_0_0/table";
  for (BodyDescription* tile : {&of_box, &of_table}) {
    tile->frame = "base";
    tile->is_world = true;
    tile->map = "octomap";
  }
  for (const bool is_protected : {false, true}) {
    permit({"add", "move", "rules"}, is_protected ? std::vector<std::string>{"octomap/*"} : std::vector<std::string>());
    const auto setTiles = [&] {
      const auto declared = [&](const char* name) { return scene_->object(name).declared; };
      scene_->setTiles({of_box, of_table},
                       {{of_box.name, {"box", declared("box")}}, {of_table.name, {"table", declared("table")}}},
                       nullptr);
    };
    apply({box(), rule(SceneChange::ALLOW, "box", "arm")});
    setTiles();
    EXPECT_EQ(body(of_box.name).name.empty(), !is_protected);
    EXPECT_TRUE(body(of_table.name).name.empty()) << "of the parameters";
    apply(box("table"));
    setTiles();
    EXPECT_EQ(body(of_table.name).name.empty(), !is_protected) << "replaced";
  }
}

/// A grasp touches the fingers, and what is next to the hand; not the rest of the robot.
TEST_F(RequestPermissionsTest, TouchLinksFarFromTheHandAreToldAlsoIfEachIsNamed) {
  parameters_.urdf =
      R"(<robot name="r"><link name="base"><collision><geometry><box size="1 1 1"/></geometry></collision>
      </link>)";
  const char* const names[] = {"base", "upper", "fore", "wrist", "hand", "finger", "tip"};
  for (int i = 1; i < 7; ++i)
    parameters_.urdf += std::string("<link name=\"") + names[i] +
                        R"("><collision><geometry><sphere radius="0.1"/></geometry></collision></link><joint name="j)" +
                        names[i] + R"(" type="continuous"><axis xyz="0 0 1"/><origin xyz="1 0 0"/><parent link=")" +
                        names[i - 1] + R"("/><child link=")" + names[i] + R"("/></joint>)";
  parameters_.urdf += "</robot>";
  described_ = describeScene(parameters_, [](const std::string&) { return Resource(); });
  permit({"add", "move", "attach"});
  const auto told = [&](const std::vector<std::string>& touch_links, const char* link = "hand") {
    SceneChange made = box();
    made.operation = SceneChange::ATTACH;
    made.link_name = link;
    made.touch_links = touch_links;
    apply(made);
    return scene_->weakened(description());
  };
  EXPECT_EQ(told({"hand", "finger", "tip", "wrist", "fore"}), "");
  EXPECT_EQ(told({"upper", "fore", "wrist", "hand", "finger", "tip"}, "upper"), "") << "a hand of many joints";
  EXPECT_EQ(told({"finger", "upper", "base"}), "requests allow 2 pairs to touch, for example base - box");
  EXPECT_EQ(told({"upper", "fore", "wrist", "hand"}, "base"),
            "requests allow 2 pairs to touch, for example wrist - box");
}

TEST_F(RequestPermissionsTest, WhatRequestsTakeFromTheChecksIsTold) {
  EXPECT_EQ(scene_->weakened(description()), "");
  apply(box());
  EXPECT_EQ(scene_->weakened(description()), "");
  apply(attach("box", {"base"}));
  EXPECT_EQ(scene_->weakened(description()), "") << "a grasp";
  EXPECT_EQ(allowedByRequests(description()), 1u);
  apply(attach("box", {"b*"}));
  EXPECT_NE(scene_->weakened(description()).find("requests allow 1 pair to touch"), std::string::npos);
  apply(change(SceneChange::REMOVE, "box"));
  apply(rule(SceneChange::ALLOW, "table", "arm"));
  EXPECT_EQ(scene_->weakened(description()), "requests allow 1 pair to touch, for example arm - table");
  apply({change(SceneChange::FORGET_RULES), change(SceneChange::REMOVE, "table")});
  EXPECT_EQ(scene_->weakened(description()),
            "requests have removed, moved, replaced or attached 1 object of the parameters, for example table");
}

TEST_F(RequestPermissionsTest, AnUnknownKindIsRefused) {
  EXPECT_THROW(permissionsOf({"add", "everything"}), std::invalid_argument);
}

}  // namespace sdf_ccd::request_permissions_test
