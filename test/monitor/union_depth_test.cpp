// Bodies of several parts that meet: the surface of one part may lie within another, so that the body is deeper there
// than its parts. Errors must cover the depth in the union.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "monitor/nearest_body.h"
#include "oracle/box_union.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "scene/body_options.h"
#include "scene/union_depth.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::union_depth_test {

using namespace test;

enum class As { kPrimitives, kMeshes };

BodyDescription bodyOf(const std::string& name, const std::vector<OrientedBox>& boxes, As as) {
  BodyDescription all;
  all.name = all.frame = name;
  for (const OrientedBox& box : boxes) {
    const Shape shape =
        as == As::kMeshes ? meshShape(boxMesh(box.half_size)) : Shape(Primitive(Box::fromSize(2.0 * box.half_size)));
    all.geometry.push_back({shape, box.X_WB, name});
  }
  return all;
}

/// A unit cube beside another, which share a face.
std::vector<OrientedBox> twoCubes() {
  return {boxAt({-0.5, 0, 0}, {0.5, 0.5, 0.5}), boxAt({0.5, 0, 0}, {0.5, 0.5, 0.5})};
}

/// An L of three boxes that share faces, and one beside them that touches none.
std::vector<OrientedBox> stairs() {
  return {boxAt({0, 0, 0}, {0.3, 0.2, 0.1}), boxAt({0.4, 0, 0.1}, {0.1, 0.2, 0.2}),
          boxAt({0, 0, 0.15}, {0.3, 0.1, 0.05}), boxAt({1.2, 0, 0}, {0.1, 0.1, 0.1})};
}

/// Queries random points in a cube, some of them very near to the plane x = 0.3 or x = 0.
/// @param has_field  the body is in a pair: so it has a field, and a solid that is exact.
void expectErrorsCoverTheUnion(const std::vector<OrientedBox>& boxes, As as, bool has_field, double half,
                               bool approximate = false) {
  std::vector<BodyDescription> bodies{bodyOf("parts", boxes, as)};
  if (has_field) bodies.push_back(body("ball", Primitive(Sphere{0.05})));
  const SceneDescription description{bodies, {}};
  const auto scene = build(description, fine(0.05));
  NearestBodySearch search(scene, std::make_shared<const SceneDescription>(description), nullptr, approximate);
  ASSERT_EQ(search.prepare(0), "");
  const Isometry3d X_WB = pose({0.1, -0.2, 0.3}, 0.7, Vector3d(1, 2, -1).normalized());
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-half, half);
  int inside = 0, exact = 0;
  for (int i = 0; i < 1500; ++i) {
    Vector3d p(coordinate(random), coordinate(random), coordinate(random));
    if (i % 4 == 0) p.x() = (i % 8 == 0 ? 0.3 : 0.0) + 1e-6;
    const double truth = distanceToUnion(boxes, p);
    const NearestBody nearest = search.nearest({X_WB, Isometry3d::Identity()}, X_WB * p);
    ASSERT_LE(std::abs(nearest.distance - truth), nearest.error + 1e-9)
        << p.transpose() << ": " << nearest.distance << " +- " << nearest.error << ", true " << truth;
    if ((has_field && !approximate) || (truth > 0.0 && as == As::kPrimitives)) {
      ASSERT_LT(nearest.error, 1e-8);
    }
    inside += truth < -1e-3;
    exact += truth < -1e-3 && nearest.error < 1e-8;
  }
  EXPECT_GT(inside, 50);
  if (as == As::kPrimitives) {
    EXPECT_GT(exact, inside / 20);  // away from the faces where parts meet the error is a part's
  }
}

TEST(UnionDepth, ErrorsOfPointsCoverTwoCubes) {
  expectErrorsCoverTheUnion(twoCubes(), As::kPrimitives, true, 1.1);
  expectErrorsCoverTheUnion(twoCubes(), As::kPrimitives, false, 1.1);
  expectErrorsCoverTheUnion(twoCubes(), As::kPrimitives, true, 1.1, true);
}

TEST(UnionDepth, ErrorsOfPointsCoverTwoMeshes) {
  expectErrorsCoverTheUnion(twoCubes(), As::kMeshes, true, 1.1);
  expectErrorsCoverTheUnion(twoCubes(), As::kMeshes, false, 1.1);
  expectErrorsCoverTheUnion(twoCubes(), As::kMeshes, true, 1.1, true);
}

TEST(UnionDepth, ErrorsOfPointsCoverStairs) {
  expectErrorsCoverTheUnion(stairs(), As::kPrimitives, true, 0.55);
  expectErrorsCoverTheUnion(stairs(), As::kMeshes, true, 0.55);
  expectErrorsCoverTheUnion(stairs(), As::kMeshes, true, 0.55, true);
}

/// One centimetre from the face that they share it is half a metre deep.
TEST(UnionDepth, APointBesideASeam) {
  const SceneDescription description{
      {bodyOf("parts", twoCubes(), As::kPrimitives), body("ball", Primitive(Sphere{0.1}))}, {}};
  NearestBodySearch search(build(description), std::make_shared<const SceneDescription>(description));
  search.prepare(0);
  const NearestBody nearest = search.nearest({Isometry3d::Identity()}, {0.01, 0.1, 0});
  EXPECT_NEAR(nearest.distance, -0.4, 1e-9);
  EXPECT_LT(nearest.error, 1e-8);
  EXPECT_LT((nearest.gradient_W - Vector3d::UnitY()).norm(), 1e-9) << "out of the whole body";
  EXPECT_LT(search.nearest({Isometry3d::Identity()}, {0.7, 0, 0.45}).error, 1e-8);
}

/// A half-space and a post on it have no box; the way out is along the normal, or none is known.
TEST(UnionDepth, AHalfSpaceWithAPost) {
  BodyDescription all = body("ground", ground());
  all.geometry.push_back({Primitive(Box::fromSize({0.2, 0.2, 1.0})), translation({0, 0, 0.5}), "post"});
  const SceneDescription description{{all}, {}};
  NearestBodySearch search(build(description), std::make_shared<const SceneDescription>(description));
  search.prepare(0);
  const NearestBody below = search.nearest({Isometry3d::Identity()}, {0, 0, -0.01});
  EXPECT_NEAR(below.distance, -0.01, 1e-9);
  EXPECT_GE(below.error, std::hypot(0.1, 0.01) - 0.01);  // the truth: the nearest free place beside the post
  EXPECT_LE(below.error, 1.001);
  EXPECT_LT(search.nearest({Isometry3d::Identity()}, {5, 0, -0.01}).error, 1e-9);
}

/// A blade 0.4 mm thick, 30 mm deep in a block of two boxes, at the face that they share and beside it.
TEST(UnionDepth, ABladeAtASeam) {
  const std::vector<OrientedBox> halves = {boxAt({-0.05, 0, 0}, {0.05, 0.1, 0.1}),
                                           boxAt({0.05, 0, 0}, {0.05, 0.1, 0.1})};
  constexpr double kDepth = 0.03;
  for (const As as : {As::kPrimitives, As::kMeshes}) {
    const auto scene =
        build({bodyOf("block", halves, as), body("blade", Primitive(Box::fromSize({0.0004, 0.05, 0.05})))},
              optionsForContacts());
    for (const double x : {0.0, 0.001, 0.02}) {
      Monitor monitor(scene, soft());
      CycleRequest request;
      request.max_points = 1000;
      const Isometry3d X_WP = translation({x, 0.003, 0.1 - kDepth + 0.025});
      const PairResult pair =
          monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(X_WP)}), request).pairs.front();
      EXPECT_EQ(pair.verdict, Verdict::kContact);
      EXPECT_TRUE(pair.measured);
      EXPECT_NEAR(pair.deepest.depth, kDepth, 5e-5) << x;
      EXPECT_GE(pair.deepest.depth + pair.deepest.depth_error, kDepth - 1e-9) << x;
      EXPECT_LT(pair.deepest.depth_error, 1e-4) << x;
      EXPECT_NEAR(std::abs(pair.deepest.normal_W.z()), 1.0, 1e-9) << x;
      for (const ContactPoint& point : pair.points) {
        // Points of the blade in the block, and of the block, also of its faces at the seam, in the blade.
        const double in_block = -distanceToUnion(halves, point.p_W);
        const double in_blade = -distanceToUnion({boxAt(X_WP.translation(), {0.0002, 0.025, 0.025})}, point.p_W);
        ASSERT_LE(std::min(std::abs(point.depth - in_block), std::abs(point.depth - in_blade)),
                  point.depth_error + 1e-6)
            << point.p_W.transpose();
      }
    }
  }
}

/// A round pin fills a hole of its radius, whose wall is a mesh: beside that wall, the depth is that in both together.
/// That it leaves no gap is not certain.
TEST(UnionDepth, APinThatFillsItsHole) {
  constexpr int kSides = 64;
  constexpr double kHole = 0.02, kRing = 0.05, kHalf = 0.05;
  TriangleMesh ring;
  for (const double z : {-kHalf, kHalf}) {
    for (const double radius : {kHole, kRing}) {
      for (int i = 0; i < kSides; ++i) {
        const double angle = 2.0 * kPi * i / kSides;
        ring.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
    }
  }
  const auto addQuad = [&](int a, int b, int c, int d) {
    ring.triangles.push_back({a, b, c});
    ring.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < kSides; ++i) {
    const int j = (i + 1) % kSides, out = kSides, top = 2 * kSides;
    addQuad(out + i, out + j, top + out + j, top + out + i);
    addQuad(j, i, top + i, top + j);
    addQuad(top + i, top + out + i, top + out + j, top + j);
    addQuad(i, j, out + j, out + i);
  }
  for (const double turned : {0.0, 0.004, 0.02}) {
    BodyDescription all = body("ring", meshShape(ring));
    all.geometry.push_back({Primitive(Cylinder::fromRadiusAndLength(kHole, 2.0 * kHalf)),
                            pose(Vector3d::Zero(), turned, Vector3d::UnitZ()), "pin"});
    const SceneDescription description{{all, body("ball", Primitive(Sphere{0.1}))}, {}};
    NearestBodySearch search(build(description, fine(0.05)), std::make_shared<const SceneDescription>(description));
    search.prepare(0);
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * kPi * i / kSides, radius = kHole - 1e-4;
      const NearestBody found = search.nearest({Isometry3d::Identity(), translation({9, 0, 0})},
                                               {radius * std::cos(angle), radius * std::sin(angle), 0.0});
      ASSERT_NEAR(found.distance, (radius - kRing) * std::cos(kPi / kSides), found.error + 1e-9) << turned << " " << i;
      ASSERT_GT(found.error, 0.02);
    }
  }
}

/// A cylinder sunk into the top of a box: as deep as the notches beside it are far.
TEST(UnionDepth, WhereACylinderJustMeetsABox) {
  for (const double radius : {0.02, 0.05, 0.5}) {
    for (const double sunk : {1e-6, 1e-5, 1e-4, 1e-3}) {
      BodyDescription all = body("box", Primitive(Box::fromSize({2.0, 2.0, 0.2})));
      all.geometry.push_back({Primitive(Cylinder::fromRadiusAndLength(radius, 1.0)),
                              pose({0, 0, 0.1 + radius - sunk}, kPi / 2, Vector3d::UnitX()), "cylinder"});
      const SceneDescription description{{all, body("ball", Primitive(Sphere{0.1}))}, {}};
      NearestBodySearch search(build(description, fine(0.05)), std::make_shared<const SceneDescription>(description));
      search.prepare(0);
      const NearestBody found = search.nearest({Isometry3d::Identity(), translation({9, 0, 0})}, {0, 0, 0.1});
      const double truth = std::sqrt(radius * radius - (radius - sunk) * (radius - sunk));
      ASSERT_LE(found.distance - found.error, -truth + 1e-9) << radius << " " << sunk;
      ASSERT_GE(found.distance + found.error, -truth - 1e-9) << radius << " " << sunk;
    }
  }
}

/// A capsule of a cylinder and two balls: its error is that of the tessellation.
TEST(UnionDepth, ACapsuleIsMeasuredFinely) {
  constexpr double kRadius = 0.05, kLength = 0.3;
  BodyDescription all = body("capsule", Primitive(Cylinder::fromRadiusAndLength(kRadius, kLength)));
  for (const double side : {-0.5, 0.5})
    all.geometry.push_back({Primitive(Sphere{kRadius}), translation({0, 0, side * kLength}), "cap"});
  const SceneDescription description{{all, body("ball", Primitive(Sphere{0.1}))}, {}};
  NearestBodySearch search(build(description, fine(0.05)), std::make_shared<const SceneDescription>(description));
  search.prepare(0);
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p(uniform(random, -0.06, 0.06), uniform(random, -0.06, 0.06), uniform(random, -0.22, 0.22));
    const Vector3d to_axis = p - Vector3d(0, 0, std::clamp(p.z(), -0.5 * kLength, 0.5 * kLength));
    const NearestBody found = search.nearest({Isometry3d::Identity(), translation({9, 0, 0})}, p);
    ASSERT_NEAR(found.distance, to_axis.norm() - kRadius, found.error) << p.transpose();
    ASSERT_LT(found.error, 3e-5) << p.transpose();
  }
}

/// A ball pressed into a body of several parts, wherever they meet: the depth is that in all of them together.
TEST(UnionDepth, IsThatOfAllParts) {
  Random random(3);
  for (const auto& parts : {twoCubes(), stairs()}) {
    for (const As as : {As::kPrimitives, As::kMeshes}) {
      const auto scene = build({bodyOf("parts", parts, as), body("pin", Primitive(Box::fromSize({2e-4, 2e-4, 2e-4})))},
                               optionsForContacts());
      Monitor monitor(scene, soft());
      int deep = 0;
      for (int i = 0; i < 2000; ++i) {
        const Vector3d p(uniform(random, -1.0, 1.0), uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5));
        const double truth = -distanceToUnion(parts, p);
        if (truth < 1e-3) continue;
        monitor.reset();
        const PairResult pair =
            monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation(p))}), {}).pairs.front();
        ASSERT_EQ(pair.verdict, Verdict::kContact);
        EXPECT_NEAR(pair.deepest.depth, truth, 1.8e-4 + pair.deepest.depth_error) << p.transpose();  // the pin's corner
        EXPECT_LT(pair.deepest.depth_error, 1e-4);
        ++deep;
      }
      EXPECT_GT(deep, 50);
    }
  }
}

}  // namespace sdf_ccd::union_depth_test
