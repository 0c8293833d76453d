#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "scene/scene_case.h"

namespace sdf_ccd {
namespace {

using test::translation;

constexpr double kHalf = 0.22;  // of the bin's side [m]
constexpr double kBall = 0.02;  // radius [m]

SceneOptions coarse() {
  SceneOptions options = test::fine(0.01);
  options.field.cells.reset();
  options.field.max_error = 0.008;
  return options;
}

/// The ball moves in the bin's frame from `start` to `end`.
PairResult ballAndBin(const Vector3d& start, const Vector3d& end) {
  const auto scene = test::build({test::body("ball", Primitive(Sphere{kBall})),
                                  test::body("bin", test::meshShape(test::binMesh(kHalf)))},
                                 coarse());
  Monitor monitor(scene, test::soft());
  return monitor
      .run(test::cycle(0.1, {{translation(start), translation(end)}, test::still(Isometry3d::Identity())}), {})
      .pairs.front();
}

TEST(OpenMesh, ABallFreeInALidlessBinIsNoContact) {
  const PairResult result = ballAndBin(Vector3d::Zero(), {0, 0, 0.01});
  std::printf("verdict %s depth %g +- %g error %g\n", toString(result.verdict), result.deepest.depth,
              result.deepest.depth_error, result.error.total());
  EXPECT_EQ(result.verdict, Verdict::kUncertain);
}

TEST(OpenMesh, ABallBesideALidlessBinIsClear) {
  EXPECT_EQ(ballAndBin({0.4, 0, 0}, {0.4, 0.1, 0}).verdict, Verdict::kClear);
  EXPECT_EQ(ballAndBin({0, 0, 0.4}, {0, 0.1, 0.3}).verdict, Verdict::kClear);
}

/// In through the opening, down to the middle.
TEST(OpenMesh, ABallThatEntersALidlessBinIsNoContact) {
  EXPECT_EQ(ballAndBin({0, 0, 0.4}, {0, 0, 0}).verdict, Verdict::kUncertain);
}

TEST(OpenMesh, ABallThatGoesThroughTheWallIsAContact) {
  EXPECT_EQ(ballAndBin({0.4, 0, 0}, {0, 0, 0}).verdict, Verdict::kContact);
  EXPECT_EQ(ballAndBin({0, 0, 0}, {0.4, 0, 0}).verdict, Verdict::kContact);
}

TEST(OpenMesh, ABallAtRestHalfThroughTheWallIsAContact) {
  EXPECT_EQ(ballAndBin({kHalf, 0, 0}, {kHalf, 0, 0}).verdict, Verdict::kContact);
}

}  // namespace
}  // namespace sdf_ccd
