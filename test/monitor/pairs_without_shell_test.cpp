// Pairs of which neither body can have a shell, such as an attached map against the world's: surfaces decide them, too.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "oracle/scene_case.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::pairs_without_shell_test {

using namespace test;

/// A cube of voxels about its origin.
BodyDescription cube(const std::string& name, double half, bool is_world) {
  BodyDescription map = body(name, meshShape(boxMesh({half, half, half})), is_world);
  map.geometry[0].watertight_voxels = true;
  map.geometry[0].cell_size = 0.05;
  return map;
}

/// A robot holds a map, as objects attached to a link may be, and moves it into what its row names, whose top is at
/// height 0.2.
class PairsWithoutShell : public ::testing::TestWithParam<std::string> {
 protected:
  static BodyDescription obstacle() {
    if (GetParam() == "map") return cube("obstacle", 0.2, true);
    BodyDescription plane = body("obstacle", Primitive(HalfSpace{Vector3d::UnitZ(), 0.2}), true);
    if (GetParam() == "plane") return plane;
    plane.geometry[0].shape = Primitive(HalfSpace{Vector3d::UnitZ(), -1.0});
    plane.geometry.push_back({Primitive(Box::fromSize({0.4, 0.4, 0.4})), Isometry3d::Identity(), "box"});
    return plane;
  }

  static CycleMotion lowered(double from, double to) {
    return cycle(1.0, {{translation({0, 0, from}), translation({0, 0, to})}, still(Isometry3d::Identity())});
  }

  const SceneDescription description_{{cube("load", 0.1, false), obstacle()}, {}};
};

TEST_P(PairsWithoutShell, AreDecidedBySurfaces) {
  const auto scene = build(description_);
  EXPECT_TRUE(scene->warnings.empty());
  Monitor monitor(scene, {});
  CycleRequest contacts;
  contacts.contacts = true;
  EXPECT_EQ(monitor.run(lowered(1.0, 0.3005), contacts).verdict, Verdict::kClear);
  EXPECT_EQ(monitor.run(lowered(0.3005, 0.2995), {}).verdict, Verdict::kContact);
  const PairResult pair = monitor.run(lowered(0.2995, 0.29), contacts).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_GE(pair.deepest.depth + pair.deepest.depth_error, 0.01);
  EXPECT_EQ(monitor.run(lowered(0.31, 0.5), {}).verdict, Verdict::kClear);
}

/// Without having been seen outside.
TEST_P(PairsWithoutShell, AreInContactIfOneIsInsideTheOther) {
  EXPECT_EQ(Monitor(build(description_), {}).run(lowered(0.01, 0.0), {}).verdict, Verdict::kContact);
}

TEST_P(PairsWithoutShell, AreUncertainIfTheCyclesTimeIsUsedUp) {
  CycleRequest hurried;
  hurried.max_time = 1e-9;
  Monitor monitor(build(description_), {});
  const CycleResult& result = monitor.run(lowered(1.0, 0.1), hurried);
  EXPECT_NE(result.verdict, Verdict::kClear);
}

TEST_P(PairsWithoutShell, AreCheckedAfterTheSceneChanges) {
  WorldEditor editor(fine());
  SceneDescription before = description_;
  before.bodies.erase(before.bodies.begin());
  Monitor monitor(editor.next(before)->scene, {});
  CycleMotion alone = lowered(1.0, 0.1);
  alone.X_WB.erase(alone.X_WB.begin());
  monitor.run(alone, {});
  const CycleMotion motion = lowered(1.0, 0.1);
  const auto after = editor.next(description_);
  monitor.adopt(*monitor.prepare(after->scene, &motion));
  EXPECT_EQ(monitor.run(motion, {}).verdict, Verdict::kContact);
}

INSTANTIATE_TEST_SUITE_P(Against, PairsWithoutShell, ::testing::Values("map", "plane", "plane and box"),
                         [](const auto& row) {
                           std::string name = row.param;
                           for (char& c : name) c = c == ' ' ? '_' : c;
                           return name;
                         });

}  // namespace sdf_ccd::pairs_without_shell_test
