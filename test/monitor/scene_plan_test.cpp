#include "sdf_ccd/scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "oracle/scene_case.h"
#include "scene/name_pair.h"

namespace sdf_ccd::scene_plan_test {

using namespace test;

const Primitive kBall = Sphere{0.1};

/// Per body: whether the plan needs this of it.
std::vector<bool> which(const ScenePlan& plan, bool BodyNeeds::*need) {
  std::vector<bool> bodies;
  for (const BodyNeeds& needs : plan.needs) bodies.push_back(needs.*need);
  return bodies;
}

std::string reasonOf(const ScenePlan& plan, const std::string& what) {
  for (const PairDecision& pair : plan.left_out)
    if ("pair " + pairName(pair.body_a, pair.body_b) == what) return pair.text;
  return "";
}

TEST(ScenePlan, TestsBothRolesOfOrdinaryPairs) {
  const ScenePlan plan = planScene({{body("a", kBall), body("b", kBall)}, {}});
  ASSERT_EQ(plan.pairs.size(), 1u);
  EXPECT_TRUE(plan.pairs[0].a_shell_b_field);
  EXPECT_TRUE(plan.pairs[0].b_shell_a_field);
  EXPECT_TRUE(plan.left_out.empty());
}

TEST(ScenePlan, LeavesOutAllowedPairsInEitherOrder) {
  const ScenePlan plan = planScene({{body("a", kBall), body("b", kBall), body("c", kBall)},
                                    {{"b", "a", "SRDF: Never"}, {"c", "no such link", "SRDF: Never"}}});
  EXPECT_EQ(plan.pairs.size(), 2u);
  EXPECT_EQ(reasonOf(plan, "pair a - b"), "SRDF: Never");
}

TEST(ScenePlan, LeavesOutPairsThatCannotMove) {
  std::vector<BodyDescription> bodies = {body("table", kBall, true), body("wall", kBall, true), body("a", kBall),
                                         body("tool", kBall)};
  bodies[3].frame = "a";
  const ScenePlan plan = planScene({bodies, {}});
  EXPECT_EQ(reasonOf(plan, "pair a - tool"), "in the same frame");
  EXPECT_EQ(plan.pairs.size(), 4u);
}

/// A user's wish is not watched, but a rigid joint is, also where the pair is adjacent too.
TEST(ScenePlan, OfSeveralReasonsTheFirstInOrderCounts) {
  SceneDescription scene{{body("a", kBall), body("b", kBall)}, {}};
  scene.bodies[1].frame = "a";
  const auto decided = [&] {
    const ScenePlan plan = planScene(scene);
    EXPECT_TRUE(plan.pairs.empty());
    return plan.left_out.at(0);
  };
  scene.allowed = {{"b", "a", "overlap", PairKind::kAtRest}, {"a", "b", "adjacent", PairKind::kAdjacent}};
  EXPECT_EQ(decided().kind, PairKind::kRigid);
  EXPECT_TRUE(decided().rigid);
  scene.bodies[1].frame = "b";
  EXPECT_EQ(decided().text, "adjacent");
  for (const bool is_in_a : {false, true}) {
    scene.bodies[1].frame = is_in_a ? "a" : "b";
    for (const PairKind kind : {PairKind::kSrdf, PairKind::kUser, PairKind::kTouchLinks, PairKind::kRequest}) {
      scene.allowed.push_back({"a", "b", "wish", kind});
      EXPECT_EQ(decided().kind, kind);
      EXPECT_FALSE(decided().rigid);
      std::reverse(scene.allowed.begin(), scene.allowed.end());
      EXPECT_EQ(decided().kind, kind) << "in any order of rows";
    }
    scene.allowed.resize(0);
  }
}

/// Such as of a map that the robot's base carries: while it drives, obstacles come in it.
TEST(ScenePlan, ATileOfAMapChangesInItsFrame) {
  BodyDescription tile = body("map/0_0_0", meshShape(boxMesh({1, 1, 1})), true);
  tile.frame = "base";
  tile.map = "map";
  tile.geometry[0].watertight_voxels = true;
  EXPECT_EQ(planScene({{body("base", kBall), tile}, {}}).pairs.size(), 1u);
}

TEST(ScenePlan, PairsOfTheWorldAreNotListed) {
  SceneDescription scene;
  for (int i = 0; i < 1000; ++i) scene.bodies.push_back(body("object " + std::to_string(i), kBall, true));
  scene.bodies.push_back(body("arm", kBall));
  const ScenePlan plan = planScene(scene);
  EXPECT_EQ(plan.pairs.size(), 1000u);
  EXPECT_TRUE(plan.left_out.empty());
}

TEST(ScenePlan, HalfSpacesAndVoxelsAreOnlyFields) {
  BodyDescription map = body("map", meshShape(boxMesh({1, 1, 1})), true);
  map.geometry[0].watertight_voxels = true;
  const ScenePlan plan = planScene({{map, body("arm", kBall), body("ground", ground())}, {}});
  ASSERT_EQ(plan.pairs.size(), 3u);  // map – arm, map – ground, arm – ground
  EXPECT_FALSE(plan.pairs[0].a_shell_b_field);
  EXPECT_TRUE(plan.pairs[0].b_shell_a_field);
  EXPECT_FALSE(plan.pairs[1].a_shell_b_field);
  EXPECT_FALSE(plan.pairs[1].b_shell_a_field);
  EXPECT_TRUE(plan.pairs[2].a_shell_b_field);
  EXPECT_FALSE(plan.pairs[2].b_shell_a_field);
  EXPECT_EQ(which(plan, &BodyNeeds::shell), (std::vector<bool>{false, true, false}));
  EXPECT_EQ(which(plan, &BodyNeeds::field), (std::vector<bool>{true, false, true}));
  EXPECT_EQ(which(plan, &BodyNeeds::triangles), (std::vector<bool>{true, true, true}));
  EXPECT_FALSE(plan.parts[0].shell.text.empty());
}

TEST(ScenePlan, ABodyThatOnlyMeetsHalfSpacesIsOnlyAShell) {
  const ScenePlan plan = planScene({{body("arm", kBall), body("ground", ground())}, {}});
  EXPECT_EQ(which(plan, &BodyNeeds::field), (std::vector<bool>{false, true}));
  EXPECT_EQ(plan.parts[0].field.text, "used only as a shell");
}

TEST(ScenePlan, UnusedBodiesAreNotBuilt) {
  const ScenePlan plan = planScene({{body("a", kBall), body("b", kBall)}, {{"a", "b", "never"}}});
  EXPECT_TRUE(plan.pairs.empty());
  EXPECT_EQ(which(plan, &BodyNeeds::field), (std::vector<bool>{false, false}));
  for (const PartReports& parts : plan.parts)
    for (const PartReport* part : {&parts.surface, &parts.field, &parts.shell}) {
      EXPECT_EQ(part->state, PartState::kNotNeeded);
      EXPECT_EQ(part->text, "no pair needs it");
    }
}

TEST(ScenePlan, PairsOfFailedBodiesStay) {
  std::vector<BodyDescription> bodies = {body("good", kBall), body("bad", kBall), body("also good", kBall)};
  bodies[1].failure = "no such file: bad.stl";
  bodies[1].geometry.clear();
  const ScenePlan plan = planScene({bodies, {}});
  EXPECT_EQ(plan.pairs.size(), 3u);
  EXPECT_FALSE(plan.needs[1].field);
  EXPECT_TRUE(plan.needs[0].field);
}

TEST(ScenePlan, BodiesArePreparedForATileThatIsToCome) {
  std::vector<BodyDescription> bodies = {body("link", kBall), body("tile", kBall, true)};
  bodies[1].geometry[0].watertight_voxels = true;
  bodies[1].failure = "no map has come yet";
  EXPECT_FALSE(planScene({bodies, {}}).needs[0].shell);  // a body that failed will not come
  bodies[1].map = "map";
  const ScenePlan plan = planScene({bodies, {}});
  ASSERT_EQ(plan.pairs.size(), 1u);
  EXPECT_TRUE(plan.pairs[0].a_shell_b_field);
  EXPECT_TRUE(plan.needs[0].shell);
}

TEST(ScenePlan, ALiveMapNeedsFieldsOfLinks) {
  const Shape mesh = meshShape(boxMesh({0.1, 0.1, 0.1}));
  SceneDescription scene{{body("a", mesh), body("b", mesh), body("ball", kBall), body("table", mesh, true)}, {}};
  for (const char* other : {"b", "ball", "table"}) scene.allowed.push_back({"a", other, "SRDF"});
  for (const char* other : {"ball", "table"}) scene.allowed.push_back({"b", other, "SRDF"});
  scene.allowed.push_back({"ball", "table", "SRDF"});
  EXPECT_EQ(which(planScene(scene), &BodyNeeds::field), std::vector<bool>({false, false, false, false}));
  scene.has_live_map = true;
  EXPECT_EQ(which(planScene(scene), &BodyNeeds::field), std::vector<bool>({true, true, false, false}));
}

TEST(ScenePlan, BodiesWithoutGeometryHaveNoPairs) {
  std::vector<BodyDescription> bodies = {body("a", kBall), body("frame", kBall)};
  bodies[1].geometry.clear();
  const ScenePlan plan = planScene({bodies, {}});
  EXPECT_TRUE(plan.pairs.empty());
  EXPECT_EQ(reasonOf(plan, "pair a - frame"), "without collision geometry");
}

TEST(ScenePlan, RefusesAmbiguousNames) {
  EXPECT_THROW(planScene({{body("a", kBall), body("a", kBall)}, {}}), std::invalid_argument);
  EXPECT_THROW(planScene({{body("a", kBall)}, {{"a", "a", "self"}}}), std::invalid_argument);
}

TEST(ScenePlan, LargePrimitiveIsOnlyAFieldToSmallerBodies) {
  const Primitive table = Box::fromSize({2.0, 1.0, 0.04});
  const SceneDescription scene{
      {body("table", table), body("hand", kBall), body("wall", Primitive(Box::fromSize({10, 10, 0.2})))}, {}};
  const ScenePlan plan = planScene(scene, {0.005});
  ASSERT_EQ(plan.pairs.size(), 3U);
  EXPECT_FALSE(plan.pairs[0].a_shell_b_field);  // table – hand
  EXPECT_TRUE(plan.pairs[0].b_shell_a_field);
  EXPECT_TRUE(plan.pairs[1].a_shell_b_field);  // table – wall: both are large, so both are sampled
  EXPECT_TRUE(plan.pairs[1].b_shell_a_field);
  // A large body that a smaller one could still contain keeps its shell, and so does every body at a coarse spacing.
  const SceneDescription cubes{
      {body("cube", Primitive(Box::fromSize({1.0, 1.0, 1.0}))), body("ball", Primitive(Sphere{0.4}))}, {}};
  EXPECT_TRUE(planScene(cubes, {0.001}).pairs[0].a_shell_b_field);
  EXPECT_TRUE(planScene(scene, {0.1}).pairs[0].a_shell_b_field);
  const ScenePlan two = planScene({{scene.bodies[0], scene.bodies[1]}, {}}, {0.005});
  EXPECT_FALSE(two.needs[0].shell);
  EXPECT_EQ(two.parts[0].shell.state, PartState::kNotNeeded);
  EXPECT_EQ(two.parts[0].field.state, PartState::kReady);
  EXPECT_EQ(two.parts[1].shell.state, PartState::kReady);
}

TEST(ScenePlan, TableNamesLinksThatAreOnlySeen) {
  SceneDescription description{{body("a", kBall)}, {}};
  description.visual_only = {"cover", "lid"};
  const std::string table = planTable(*build(description));
  EXPECT_NE(table.find("not checked, as they have a visual but no collision shape:\n  cover lid\n"), std::string::npos)
      << table;
}

TEST(ScenePlan, TableKeepsAnyNameOfALinkThatIsLeftOut) {
  const std::string table =
      planTable(*build({{body("of lid", kBall), body("base", kBall)}, {{"of lid", "base", "why"}}}));
  EXPECT_NE(table.find("  1 pair, why: of lid - base\n"), std::string::npos) << table;
  EXPECT_NE(table.find("  2 shells, no pair needs it: of lid, base\n"), std::string::npos) << table;
}

}  // namespace sdf_ccd::scene_plan_test
