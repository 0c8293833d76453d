#include "ros/parameters/request_permissions.h"

#include "ros/changing_scene_case.h"

namespace sdf_ccd {
namespace {

using namespace test;

class RequestPermissionsTest : public ChangingSceneCase {
 protected:
  void permit(const std::vector<std::string>& kinds, const std::vector<std::string>& protected_bodies = {}) {
    RequestPermissions permissions = permissionsOf(kinds);
    permissions.protected_bodies = protected_bodies;
    scene_ = std::make_unique<ChangingScene>(described_, parameters_.pairs, described_.scene, permissions);
  }
  void expectRefused(const SceneChange& change, const std::string& parameter) {
    EXPECT_NE(refusal(change).find(parameter), std::string::npos) << refusal(change);
  }
  static SceneChange attach(const std::string& name, std::vector<std::string> touch_links = {}) {
    SceneChange made = change(SceneChange::ATTACH, name);
    made.link = "arm";
    made.touch_links = std::move(touch_links);
    return made;
  }
};

TEST_F(RequestPermissionsTest, EachKindOfChangeNeedsItsPermission) {
  const std::vector<std::pair<std::string, SceneChange>> kinds{{"add", box()},
                                                               {"move", change(SceneChange::MOVE, "table")},
                                                               {"move", box("table")},  // replaces it
                                                               {"attach", attach("table")},
                                                               {"rules", rule(SceneChange::ALLOW, "table", "arm")},
                                                               {"rules", rule(SceneChange::CHECK, "table", "arm")},
                                                               {"rules", change(SceneChange::FORGET_RULES)},
                                                               {"clear", change(SceneChange::REMOVE, "table")},
                                                               {"clear", change(SceneChange::CLEAR)}};
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

TEST_F(RequestPermissionsTest, ByDefaultAllButLimitsIsAllowed) {
  EXPECT_EQ(refusal(box("table")), "");
  EXPECT_EQ(refusal(change(SceneChange::CLEAR)), "");
  EXPECT_TRUE(parameters_.requests.reset);
  EXPECT_FALSE(parameters_.requests.limits);
}

TEST_F(RequestPermissionsTest, WhatIsProtectedStays) {
  permit({"add", "move", "attach", "rules", "clear"}, {"ta*", "base"});
  apply(box());
  for (const SceneChange& wanted :
       {change(SceneChange::MOVE, "table"), box("table"), change(SceneChange::REMOVE, "table"),
        change(SceneChange::REMOVE, "*"), change(SceneChange::CLEAR), attach("table"), attach("box", {"*"}),
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
  EXPECT_EQ(scene_->allowedByRequests(description()), 1u);
}

TEST_F(RequestPermissionsTest, WhatRequestsTakeFromTheChecksIsTold) {
  EXPECT_EQ(scene_->weakened(description()), "");
  apply(box());
  EXPECT_EQ(scene_->weakened(description()), "");
  apply(attach("box", {"base"}));
  EXPECT_EQ(scene_->weakened(description()), "") << "a grasp";
  EXPECT_EQ(scene_->allowedByRequests(description()), 1u);
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

}  // namespace
}  // namespace sdf_ccd
