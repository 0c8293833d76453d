#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "oracle/scene_case.h"
#include "scene/body_surface.h"
#include "shell/point_shell.h"

namespace sdf_ccd::open_mesh_test {

using test::translation;

constexpr double kHalf = 0.22;  // half of the bin's side [m]
constexpr double kBall = 0.02;  // radius [m]

BodyOptions coarse() {
  BodyOptions options = test::fine(0.01);
  options.field.cells.reset();
  options.field.max_error = 0.008;
  return options;
}

/// Result for the ball that moves from `start` to `end` in the bin's frame.
PairResult ballAndBin(const Vector3d& start, const Vector3d& end) {
  const auto scene = test::build(
      {test::body("ball", Primitive(Sphere{kBall})), test::body("bin", test::meshShape(test::binMesh(kHalf)))},
      coarse());
  Monitor monitor(scene, test::soft());
  return monitor
      .run(test::cycle(0.1, {{translation(start), translation(end)}, test::still(Isometry3d::Identity())}), {})
      .pairs.front();
}

TEST(OpenMesh, ABallFreeInALidlessBinIsNoContact) {
  const PairResult result = ballAndBin(Vector3d::Zero(), {0, 0, 0.01});
  EXPECT_EQ(result.verdict, Verdict::kUncertain);
  // Its depth may be wrong altogether, so it is not pushed.
  EXPECT_GE(result.deepest.depth_error, result.deepest.depth);
  EXPECT_EQ(result.on_a_W.force.norm(), 0.0);
}

TEST(OpenMesh, ABallBesideALidlessBinIsClear) {
  EXPECT_EQ(ballAndBin({0.4, 0, 0}, {0.4, 0.1, 0}).verdict, Verdict::kClear);
  EXPECT_EQ(ballAndBin({0, 0, 0.4}, {0, 0.1, 0.3}).verdict, Verdict::kClear);
}

/// In through the opening, down to the centre.
TEST(OpenMesh, ABallThatEntersALidlessBinIsNoContact) {
  EXPECT_EQ(ballAndBin({0, 0, 0.4}, {0, 0, 0}).verdict, Verdict::kUncertain);
}

TEST(OpenMesh, ABallThatGoesThroughTheWallIsAContact) {
  EXPECT_EQ(ballAndBin({0.4, 0, 0}, {0, 0, 0}).verdict, Verdict::kContact);
  EXPECT_EQ(ballAndBin({0, 0, 0}, {0.4, 0, 0}).verdict, Verdict::kContact);
}

TEST(OpenMesh, ABallAtRestHalfThroughTheWallIsAContact) {
  const PairResult result = ballAndBin({kHalf, 0, 0}, {kHalf, 0, 0});
  EXPECT_EQ(result.verdict, Verdict::kContact);
  EXPECT_GT(result.on_a_W.force.x(), 0.0) << "out by the wall";
}

/// It starts at the wall and moves to the centre, without ever having been inside the wall.
TEST(OpenMesh, ABallThatLeavesTheWallFromWithinIsNoContact) {
  for (const double gap : {-0.0005, 0.0, 0.0005, 0.002}) {
    const double start = kHalf - kBall - gap;
    EXPECT_EQ(ballAndBin({start, 0, 0}, {0, 0, 0}).verdict, gap < 0.0 ? Verdict::kContact : Verdict::kUncertain) << gap;
  }
}

/// Halfway through the opening, where there is no surface.
TEST(OpenMesh, ABallAtRestInTheOpeningIsNoContact) {
  EXPECT_EQ(ballAndBin({0, 0, kHalf}, {0, 0, kHalf}).verdict, Verdict::kUncertain);
}

/// A thin pad lies on the bin's floor. The ball dips into it by less than the motion error, and moves to the centre of
/// the bin. Neither proves a contact, and together they do not either, although the ball is far inside the closed bin
/// and was inside the pad.
TEST(OpenMesh, ABallFreeInALidlessBinFromItsPadIsNoContact) {
  constexpr double kPad = 0.006, kDip = 0.004, kError = 0.005;
  for (const bool with_bin : {false, true}) {
    BodyDescription padded = test::body("bin", Primitive(Box::fromSize({0.06, 0.06, kPad})));
    padded.geometry[0].X_BG = translation({0, 0, -kHalf + 0.5 * kPad});
    if (with_bin) padded.geometry.push_back({test::meshShape(test::binMesh(kHalf)), Isometry3d::Identity(), "bin.stl"});
    BodyOptions options = coarse();
    options.field.max_error = 1e-3;
    const auto scene = test::build({test::body("ball", Primitive(Sphere{kBall})), padded}, options);
    Monitor monitor(scene, test::soft());
    CycleMotion motion = test::cycle(0.1, {{translation({0, 0, -kHalf + kPad - kDip + kBall}), translation({0, 0, 0})},
                                           test::still(Isometry3d::Identity())});
    motion.motion_error = {kError, 0.0};
    const PairResult result = monitor.run(motion, {}).pairs.front();
    EXPECT_EQ(result.verdict, Verdict::kUncertain) << with_bin;
    EXPECT_FALSE(result.intervals.empty()) << with_bin;
  }
}

/// A sheet has no inside, so nothing is ever deep in it; a rod through it crosses it nevertheless.
TEST(OpenMesh, ARodThroughASheetIsAContact) {
  TriangleMesh sheet;
  sheet.vertices = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto scene = test::build(
      {test::body("rod", Primitive(Box::fromSize({0.04, 0.06, 0.4}))), test::body("sheet", test::meshShape(sheet))},
      coarse());
  Monitor monitor(scene, test::soft());
  const auto verdictAt = [&](double z) {
    const Isometry3d X = test::pose({0.1, 0.05, z}, 0.3, {1, 2, 3});
    return monitor.run(test::cycle(0.1, {test::still(X), test::still(Isometry3d::Identity())}), {}).pairs.front();
  };
  const PairResult through = verdictAt(0.0);
  EXPECT_EQ(through.verdict, Verdict::kContact);
  ASSERT_FALSE(through.intervals.empty());
  EXPECT_NEAR(through.deepest.p_W.z(), 0.0, 0.05);
  EXPECT_EQ(verdictAt(0.3).verdict, Verdict::kClear);
}

/// The shell samples the triangles of the bin, not its cap.
TEST(OpenMesh, ShellsHaveNoPointsOnCaps) {
  const auto scene = test::build(
      {test::body("ball", Primitive(Sphere{kBall})), test::body("bin", test::meshShape(test::binMesh(kHalf)))},
      coarse());
  for (const Vector3d& p : scene->bodies[1].shell->points()) {
    EXPECT_TRUE(p.z() < kHalf - 1e-9 || p.head<2>().lpNorm<Eigen::Infinity>() > kHalf - 1e-9) << p.transpose();
  }
}

}  // namespace sdf_ccd::open_mesh_test
