#include "monitor/rigid_watch.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::rigid_watch_test {

using namespace test;

Isometry3d at(double x, double angle = 0.0) {
  return Isometry3d(Eigen::Translation3d(x, 0.0, 0.0)) * Eigen::AngleAxisd(angle, Vector3d::UnitZ());
}

/// Bodies a metre apart along x, which fixed joints join to the first.
class RigidWatchTest : public ::testing::Test {
 protected:
  void add(const std::string& name, const Primitive& shape) {
    BodyDescription added = body(name, shape);
    added.rigid_root = "a";
    added.X_root_frame = at(double(description_.bodies.size()));
    description_.bodies.push_back(added);
  }

  /// The names of the pairs that a motion of two seconds moves.
  std::vector<std::string> moved(const std::vector<std::vector<Isometry3d>>& X_WB,
                                 const std::vector<WaypointSpan>& spans = {}) const {
    CycleMotion motion;
    motion.times = {0.0, 1.0, 2.0};
    motion.X_WB = X_WB;
    motion.missing = missing_;
    Scene scene;
    scene.left_out = planScene(description_).left_out;
    for (const BodyDescription& described : description_.bodies) {
      Body added;
      added.name = described.name;
      scene.bodies.push_back(added);
    }
    const RigidWatch watch(scene);
    std::vector<char> has_moved(watch.pairs().size(), 0);
    watch.find(motion, spans, has_moved);
    std::vector<std::string> names;
    for (std::size_t p = 0; p < has_moved.size(); ++p) {
      const PlannedPair& pair = watch.pairs()[p];
      if (has_moved[p])
        names.push_back(description_.bodies[pair.body_a].name + " - " + description_.bodies[pair.body_b].name);
    }
    return names;
  }

  using Names = std::vector<std::string>;

  SceneDescription description_;
  std::vector<std::string> missing_;
};

TEST_F(RigidWatchTest, BodiesMayDeviateByAMillimetreAtTheCornersOfTheirBoxes) {
  add("a", Sphere{0.1});
  add("b", Box::fromSize({0.06, 0.08, 0.24}));  // corners at 0.13 m
  const auto hasMoved = [&](const Isometry3d& X_WB) { return !moved({{at(0)}, {at(1), at(1), X_WB}}).empty(); };
  EXPECT_FALSE(hasMoved(at(1)));
  EXPECT_FALSE(hasMoved(at(1.0009)));
  EXPECT_TRUE(hasMoved(at(1.0011)));
  EXPECT_FALSE(hasMoved(at(1, 0.0009 / 0.13)));
  EXPECT_TRUE(hasMoved(at(1, 0.0011 / 0.13)));
  EXPECT_TRUE(hasMoved(at(1, 3.0))) << "about its own origin";
  EXPECT_FALSE(moved({{at(0), at(2, 1.0), at(5, 3.0)}, {at(1), at(2, 1.0) * at(1), at(5, 3.0) * at(1)}}) != Names())
      << "as one";
}

TEST_F(RigidWatchTest, APlaneIsInfinite) {
  add("a", ground());
  add("b", Sphere{0.1});
  description_.bodies[1].X_root_frame = at(1000.0);
  const auto hasMoved = [&](double angle) {
    return !moved({{at(0)}, {at(1000), at(1000), Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitY())) * at(1000)}})
                .empty();
  };
  EXPECT_FALSE(hasMoved(0.0));
  EXPECT_TRUE(hasMoved(2e-6)) << "by 2 mm there, but by no more than 0.02 mm within 10 m of the plane's origin";
}

TEST_F(RigidWatchTest, OnlyWhatMovesAgainstTheOthersCounts) {
  for (const char* name : {"a", "b", "c", "d"}) add(name, Sphere{0.1});
  description_.allowed = {{"a", "b", "may touch"}};
  const std::vector<Isometry3d> rest = {at(0)}, moves = {at(1), at(1.01), at(1)};
  EXPECT_EQ(moved({rest, moves, {at(2)}, {at(3)}}), (Names{"b - c", "b - d"})) << "at one waypoint";
  EXPECT_EQ(moved({{at(0), at(0.01), at(0)}, {at(1)}, {at(2)}, {at(3)}}), (Names{"a - c", "a - d"}));
  EXPECT_EQ(moved({rest, {at(1)}, {at(2), at(2.5), at(2.5)}, {at(3), at(3.5), at(3.5)}}),
            (Names{"a - c", "a - d", "b - c", "b - d"}));
}

TEST_F(RigidWatchTest, OnlyKnownPosesWithinASpanAreCompared) {
  for (const char* name : {"a", "b", "c"}) add(name, Sphere{0.1});
  const std::vector<std::vector<Isometry3d>> X_WB = {{at(0)}, {at(1), at(1), at(1.5)}, {at(2)}};
  EXPECT_EQ(moved(X_WB, {{0, 1}, {0, 2}, {0, 2}}), Names{"b - c"});
  EXPECT_EQ(moved(X_WB, {{0, 1}, {0, 2}, {2, 2}}), Names()) << "an empty span";
  missing_ = {"gone", "", ""};
  EXPECT_EQ(moved({{}, X_WB[1], X_WB[2]}), Names{"b - c"});
  missing_ = {"", "gone", ""};
  EXPECT_EQ(moved({X_WB[0], {}, X_WB[2]}), Names());
}

}  // namespace sdf_ccd::rigid_watch_test
