#include <gtest/gtest.h>

#include "oracle/scene_case.h"

/// Bodies of several parts for which no shell can be made: a part wholly inside another body must be detected.
namespace sdf_ccd::several_parts_test {

using namespace test;

void addPart(const Shape& shape, const Isometry3d& X_BG, BodyDescription& body, bool voxels = false) {
  body.geometry.push_back({shape, X_BG, "part" + std::to_string(body.geometry.size()), voxels});
}

/// Result for both bodies at rest.
PairResult atRest(const std::shared_ptr<const Scene>& scene, const Isometry3d& X_WA, const Isometry3d& X_WB) {
  Monitor monitor(scene, soft());
  return monitor.run(cycle(0.1, {still(X_WA), still(X_WB)}), {}).pairs.front();
}

/// A half-space, and above it a ball of 5 cm radius that other bodies may enclose.
BodyDescription groundAndBall() {
  BodyDescription fixture = body("fixture", ground());
  addPart(Primitive(Sphere{0.05}), translation({0, 0, 1}), fixture);
  return fixture;
}

TEST(SeveralParts, ABallBesideAHalfSpaceWhollyInsideABox) {
  const auto scene = build({groundAndBall(), body("box", Primitive(Box::fromSize({0.6, 0.6, 0.6})))});
  const Isometry3d at_rest = Isometry3d::Identity();
  EXPECT_EQ(atRest(scene, at_rest, translation({0, 0, 1})).verdict, Verdict::kContact);
  EXPECT_EQ(atRest(scene, at_rest, translation({0, 0.5, 1})).verdict, Verdict::kClear);
}

TEST(SeveralParts, AMeshBesideAHalfSpaceWhollyInsideABox) {
  BodyDescription fixture = body("fixture", ground());
  addPart(meshShape(boxMesh({0.05, 0.05, 0.05})), translation({0, 0, 1}), fixture);
  const auto scene = build({fixture, body("box", Primitive(Box::fromSize({0.6, 0.6, 0.6})))});
  EXPECT_EQ(atRest(scene, Isometry3d::Identity(), translation({0, 0, 1})).verdict, Verdict::kContact);
}

TEST(SeveralParts, ABallBesideVoxelsWhollyInsideABox) {
  BodyDescription map = body("map", meshShape(boxMesh({0.1, 0.1, 0.1})));
  map.geometry[0].watertight_voxels = true;
  addPart(Primitive(Sphere{0.05}), translation({0, 0, 1}), map);
  const auto scene = build({map, body("box", Primitive(Box::fromSize({0.6, 0.6, 0.6})))});
  EXPECT_EQ(atRest(scene, Isometry3d::Identity(), translation({0, 0, 1})).verdict, Verdict::kContact);
}

BodyDescription groundAndVoxels() {
  BodyDescription fixture = body("fixture", ground());
  addPart(meshShape(boxMesh({0.1, 0.1, 0.1})), translation({0, 0, 1}), fixture, true);
  return fixture;
}

/// The ball that represents a body with a half-space does not contain the half-space.
TEST(SeveralParts, FarOutOnAHalfSpaceThatHasVoxels) {
  const auto scene = build({groundAndVoxels(), body("ball", Primitive(Sphere{0.1}))});
  EXPECT_EQ(atRest(scene, Isometry3d::Identity(), translation({100, 0, 0.05})).verdict, Verdict::kContact);
}

/// Half-space and voxels rotate together: points far out move far.
TEST(SeveralParts, AHalfSpaceWithVoxelsThatTurnsInSmallSteps) {
  const auto scene = build({groundAndVoxels(), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const auto turned = [](int step) { return pose({0, 0, 0}, -2e-4 * step, {0, 1, 0}); };
  const Isometry3d ball = translation({100, 0, 1});  // 0.9 m above the ground, which takes 45 steps
  for (int step = 0; step < 60; ++step) {
    const PairResult result =
        monitor.run(cycle(0.1, {{turned(step), turned(step + 1)}, still(ball)}), {}).pairs.front();
    const double distance = (turned(step + 1).inverse() * ball.translation()).z() - 0.1;
    const bool is_clear = result.verdict == Verdict::kClear;
    ASSERT_TRUE(distance > 0.0 || !is_clear) << "step " << step << ", " << distance;
    ASSERT_TRUE(result.clearance <= distance + 1e-9 || !is_clear) << "step " << step << ", " << distance;
  }
}

/// Three walls that meet in a corner, with free space where x, y, z > 0; slightly rotated, not aligned with the field's
/// cells.
BodyDescription corner(const Isometry3d& turn) {
  TriangleMesh walls;
  for (int k = 0; k < 3; ++k) {
    Vector3d low = Vector3d::Constant(-0.05), high = Vector3d::Constant(0.2);
    high[k] = 0.0;
    walls = merged(walls, translated(boxMesh(0.5 * (high - low)), 0.5 * (low + high)));
  }
  return body("corner", meshShape(transformed(walls, turn)));
}

/// The corner's field is the coarser one; the depth of the tip has its error.
TEST(SeveralParts, ATipThatDoesNotReachIntoACorner) {
  const Isometry3d turn = pose({0, 0, 0}, 0.2, {1, 2, 3});
  const double s = 0.02;
  const TriangleMesh tip{{{0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  BodyDescription fixture = body("fixture", Primitive(HalfSpace{{0, 0, 1}, -10.0}));
  addPart(meshShape(tip), Isometry3d::Identity(), fixture);
  const auto scene = build({fixture, corner(turn)});
  for (double t = 1e-4; t < 0.02; t += 2e-4) {
    const PairResult result = atRest(scene, turn * translation({t, t, t}), Isometry3d::Identity());
    EXPECT_NE(result.verdict, Verdict::kContact) << t << " m apart, " << result.deepest.depth;
  }
}

}  // namespace sdf_ccd::several_parts_test
