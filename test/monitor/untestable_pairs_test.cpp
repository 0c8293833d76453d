#include "monitor/untestable_pairs.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "oracle/scene_case.h"
#include "sdf_ccd/monitor/world.h"

namespace sdf_ccd::untestable_pairs_test {

using namespace test;

/// A cube of voxels about its origin, of 0.2 m.
BodyDescription cube(const std::string& name, bool is_world) {
  BodyDescription map = body(name, meshShape(boxMesh({0.1, 0.1, 0.1})), is_world);
  map.geometry[0].watertight_voxels = true;
  map.geometry[0].cell_size = 0.05;
  return map;
}

PairResult pairOf(const CycleResult& result, const Scene& scene, const std::string& a, const std::string& b) {
  for (const PairResult& pair : result.pairs)
    if (scene.bodies[pair.body_a].name == a && scene.bodies[pair.body_b].name == b) return pair;
  ADD_FAILURE() << a << " - " << b << " is not among the pairs";
  return {};
}

/// A robot holds a map, as objects attached to a link may be, and moves it into what its row names.
class UntestablePairs : public ::testing::TestWithParam<std::string> {
 protected:
  static BodyDescription obstacle() {
    if (GetParam() == "map") return cube("obstacle", true);
    if (GetParam() == "plane") return body("obstacle", ground(), true);
    BodyDescription mixed = body("obstacle", ground(), true);
    mixed.geometry.push_back({Primitive(Sphere{0.1}), Isometry3d::Identity(), "sphere"});
    return mixed;
  }

  const SceneDescription description_{{cube("load", false), body("arm", Primitive(Sphere{0.05})), obstacle()}, {}};
  /// The load ends deep inside the obstacle; the arm stays far above.
  const CycleMotion motion_ = cycle(
      1.0,
      {{translation({0, 0, 1}), Isometry3d::Identity()}, still(translation({0, 0, 2})), still(Isometry3d::Identity())});
};

TEST_P(UntestablePairs, AreNotCheckedAndNamed) {
  const auto scene = build(description_);
  Monitor monitor(scene, {});
  for (int i = 0; i < 3; ++i) {
    const CycleResult& result = monitor.run(motion_, {});
    EXPECT_EQ(result.verdict, Verdict::kNotChecked);
    EXPECT_EQ(result.not_checked, 1);
    const PairResult pair = pairOf(result, *scene, "load", "obstacle");
    EXPECT_EQ(pair.verdict, Verdict::kNotChecked);
    EXPECT_EQ(pair.reason, kNotTestable);
    EXPECT_EQ(pairOf(result, *scene, "arm", "obstacle").verdict, Verdict::kClear);
  }
  ASSERT_EQ(scene->warnings.size(), 1U);
  EXPECT_EQ(scene->warnings[0], std::string("1 pair cannot be checked, as ") + kNotTestable + ": load - obstacle");
}

TEST_P(UntestablePairs, AreNotCheckedIfTheCyclesTimeIsUsedUp) {
  CycleRequest hurried;
  hurried.max_time = 1e-9;
  const auto scene = build(description_);
  const CycleResult result = Monitor(scene, {}).run(motion_, hurried);
  EXPECT_EQ(pairOf(result, *scene, "load", "obstacle").verdict, Verdict::kNotChecked);
}

TEST_P(UntestablePairs, AreNotCheckedAfterTheSceneChanges) {
  WorldEditor editor(fine());
  SceneDescription before = description_;
  before.bodies.erase(before.bodies.begin());
  Monitor monitor(editor.next(before)->scene, {});
  CycleMotion motion_before = motion_;
  motion_before.X_WB.erase(motion_before.X_WB.begin());
  EXPECT_EQ(monitor.run(motion_before, {}).verdict, Verdict::kClear);
  const auto after = editor.next(description_);
  monitor.adopt(*monitor.prepare(after->scene, &motion_));
  EXPECT_EQ(pairOf(monitor.run(motion_, {}), *after->scene, "load", "obstacle").verdict, Verdict::kNotChecked);
  ASSERT_EQ(after->warnings.size(), 1U);
  EXPECT_NE(after->warnings[0].find("load - obstacle"), std::string::npos) << after->warnings[0];
}

TEST_P(UntestablePairs, NeedAnotherBodysPairToBeBuilt) {
  SceneDescription two = description_;
  two.bodies.erase(two.bodies.begin() + 1);  // the arm
  const ScenePlan plan = planScene(two);
  ASSERT_EQ(plan.pairs.size(), 1U);
  EXPECT_FALSE(plan.pairs[0].isTestable());
  for (const BodyNeeds& needs : plan.needs) EXPECT_FALSE(needs.any());
  const auto scene = build(two);
  CycleMotion motion = motion_;
  motion.X_WB.erase(motion.X_WB.begin() + 1);
  EXPECT_EQ(Monitor(scene, {}).run(motion, {}).verdict, Verdict::kNotChecked);
}

INSTANTIATE_TEST_SUITE_P(Against, UntestablePairs, ::testing::Values("map", "plane", "plane and sphere"),
                         [](const auto& row) {
                           std::string name = row.param;
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

/// A live map that is still to come.
TEST(UntestablePairs, OfAnAwaitedTileAreNotChecked) {
  BodyDescription tile = cube("tile", true);
  tile.failure = "no map has come yet";
  tile.map = "map";
  const auto scene = build({cube("load", false), tile});
  ASSERT_EQ(scene->pairs.size(), 1U);
  const CycleResult result =
      Monitor(scene, {}).run(cycle(1.0, {still(Isometry3d::Identity()), still(Isometry3d::Identity())}), {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.pairs[0].reason, "no map has come yet");
  EXPECT_TRUE(scene->warnings.empty());
}

TEST(UntestablePairs, ManyAreCountedAndSomeAreNamed) {
  std::vector<BodyDescription> bodies = {cube("load", false)};
  for (int i = 0; i < 20; ++i) bodies.push_back(cube("tile " + std::to_string(i), true));
  const auto scene = build(bodies);
  ASSERT_EQ(scene->warnings.size(), 1U);
  EXPECT_EQ(scene->warnings[0], std::string("20 pairs cannot be checked, as ") + kNotTestable +
                                    ": load - tile 0, load - tile 1, load - tile 2, load - tile 3 and 16 more");
}

TEST(UntestablePairs, OfBodiesThatAreGivenPreparedAreNotChecked) {
  const auto halfSpace = [](const std::string& name) {
    return prepareBody(name, HalfSpace{Vector3d::UnitZ(), 0.0}, {5e-3, {}});
  };
  const Scene scene = makeScene({halfSpace("floor"), halfSpace("hand"), prepareBody("ball", Sphere{0.1}, {5e-3, {}})});
  ASSERT_EQ(scene.pairs.size(), 3U);
  EXPECT_EQ(scene.warnings.size(), 1U);
  const CycleResult result = Monitor(std::make_shared<const Scene>(scene), {})
                                 .run(cycle(1.0, {still(Isometry3d::Identity()), still(translation({0, 0, -9})),
                                                  still(translation({0, 0, 1}))}),
                                      {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.pairs[0].reason, kNotTestable);
  EXPECT_EQ(result.pairs[1].verdict, Verdict::kClear);
}

}  // namespace sdf_ccd::untestable_pairs_test
