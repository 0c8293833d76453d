#include "monitor/untestable_pairs.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "oracle/scene_case.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::untestable_pairs_test {

using namespace test;

/// A cube of voxels about its origin, of 0.2 m.
BodyDescription cube(const std::string& name, bool is_world) {
  BodyDescription map = body(name, meshShape(boxMesh({0.1, 0.1, 0.1})), is_world);
  map.geometry[0].watertight_voxels = true;
  map.geometry[0].cell_size = 0.05;
  return map;
}

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

TEST(UntestablePairs, NeedNothingToBeBuilt) {
  const ScenePlan plan = planScene({{body("floor", ground(), true), body("shield", ground())}, {}});
  ASSERT_EQ(plan.pairs.size(), 1U);
  for (const BodyNeeds& needs : plan.needs) EXPECT_FALSE(needs.any());
}

TEST(UntestablePairs, ManyAreCountedAndSomeAreNamed) {
  std::vector<BodyDescription> bodies = {body("shield", ground())};
  for (int i = 0; i < 20; ++i) bodies.push_back(body("floor " + std::to_string(i), ground(), true));
  const auto scene = build(bodies);
  ASSERT_EQ(scene->warnings.size(), 1U);
  EXPECT_EQ(scene->warnings[0],
            std::string("20 pairs cannot be checked, as ") + kNotTestable +
                ": shield - floor 0, shield - floor 1, shield - floor 2, shield - floor 3 and 16 more");
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
