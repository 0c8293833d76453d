// Bodies wholly inside others, whose surfaces are apart.
#include <algorithm>

#include <gtest/gtest.h>

#include "monitor/surface_pair_case.h"
#include "oracle/drawn_meshes.h"
#include "oracle/open_shapes.h"
#include "oracle/shapes.h"
#include "scene/body_triangles.h"

namespace sdf_ccd::containment_test {

using namespace test;

/// A body wholly inside touches no surface, and yet is in contact (design §3.15), also without a previous cycle; in a
/// cavity it is not.
TEST(Containment, WhatIsWhollyInsideIsAContact) {
  const TriangleMesh cavity = flipped(boxMesh({0.1, 0.1, 0.1}));
  const auto solid = build({body("block", meshShape(boxMesh({0.2, 0.2, 0.2}))), body("bead", Primitive(Sphere{0.02}))},
                           coarse()),
             hollow = build({body("block", meshShape(merged(boxMesh({0.2, 0.2, 0.2}), cavity))),
                             body("bead", Primitive(Sphere{0.02}))},
                            coarse());
  Monitor in_solid(solid, soft()), in_hollow(hollow, soft());
  EXPECT_EQ(at(in_solid, translation({0.01, 0, 0})).verdict, Verdict::kContact);
  EXPECT_EQ(at(in_hollow, translation({0.01, 0, 0})).verdict, Verdict::kClear);
  EXPECT_EQ(at(in_hollow, translation({0.15, 0, 0})).verdict, Verdict::kContact);
  EXPECT_EQ(at(in_hollow, translation({0.25, 0, 0})).verdict, Verdict::kClear);
  // One of two parts is inside.
  BodyDescription two = body("two", Primitive(Sphere{0.02}));
  two.geometry.push_back({Primitive(Sphere{0.02}), translation({0.5, 0, 0}), "other"});
  const auto parts = build({body("block", meshShape(boxMesh({0.2, 0.2, 0.2}))), two}, coarse());
  Monitor in_part(parts, soft());
  EXPECT_EQ(at(in_part, translation({0, 0, 0})).verdict, Verdict::kContact);
  EXPECT_EQ(at(in_part, translation({-0.5, 0, 0})).verdict, Verdict::kContact);
  EXPECT_EQ(at(in_part, translation({0.25, 0, 0})).verdict, Verdict::kClear);
}

/// Inside is known by the surfaces also where fields are too coarse to tell, and for the whole cycle; with contacts or
/// without.
TEST(Containment, WhatIsInsideByLessThanTheFieldsErrorIsAContact) {
  BodyOptions options = coarse();
  options.field.cells = 4;
  const TriangleMesh wall = boxMesh({1.0, 1.0, 0.004});
  BodyDescription shelf = body("shelf", meshShape(wall));
  shelf.geometry.push_back({meshShape(wall), translation({0, 0, 1}), "upper"});
  const auto scene = build({shelf, body("bead", meshShape(boxMesh({0.001, 0.001, 0.001})))}, options);
  for (const bool wants_contacts : {false, true}) {
    CycleRequest request;
    request.contacts = request.wrenches = wants_contacts;
    for (const double z : {0.0, 0.0029, 0.998}) {
      Monitor monitor(scene, soft());
      const auto still_shelf = still(translation({0, 2, 0}));
      const std::vector<Isometry3d> bead = {translation({0.1, 2, z}), translation({0.2, 2.1, z})};
      const PairResult result = monitor.run(cycle(0.1, {still_shelf, bead}), request).pairs.front();
      ASSERT_EQ(result.verdict, Verdict::kContact) << z;
      ASSERT_EQ(result.intervals.size(), 1u);
      EXPECT_EQ(result.intervals[0].enter, 0.0);
      EXPECT_EQ(result.intervals[0].exit, 0.1);
      const double then = 0.1 + result.deepest.time;  // the bead's x
      EXPECT_LE((result.deepest.p_W - Vector3d(then, then + 1.9, z)).cwiseAbs().maxCoeff(), 0.0011) << "in the bead";
    }
  }
}

/// Without shell points inside, the contact is the point that proves it; within the span.
TEST(Containment, WhatNoPointFeelsInsideHasAPlaceAndANormal) {
  const TriangleMesh wall = boxMesh({1.0, 1.0, 0.004});
  BodyOptions options = coarse();
  options.field.cells = 4;
  const auto scene = build({body("walls", meshShape(merged(wall, translated(wall, {0, 0, 1})))),
                            body("bead", meshShape(boxMesh({0.001, 0.001, 0.001})))},
                           options);
  Monitor monitor(scene, soft());
  const Vector3d place(0.1, 2, 1.001);
  CycleMotion motion = cycle(0.1, {still(translation({0, 2, 0}), 3), still(translation(place), 3)});
  for (const std::size_t first : {0, 1}) {
    motion.spans = {{first, 2}};
    monitor.reset();
    const PairResult& result = monitor.run(motion, {}).pairs.front();
    ASSERT_EQ(result.verdict, Verdict::kContact);
    ASSERT_EQ(result.intervals.size(), 1u);
    EXPECT_EQ(result.intervals[0].enter, motion.times[first]);
    EXPECT_EQ(result.intervals[0].exit, 0.1);
    EXPECT_LE((result.deepest.p_W - place).cwiseAbs().maxCoeff(), 0.0011);
    EXPECT_NEAR(result.deepest.normal_W.norm(), 1.0, 1e-9);
    EXPECT_EQ(result.deepest.enter, motion.times[first]);
    EXPECT_EQ(result.peaks.size(), 1u);
  }
}

/// A bead that enters a solid through its surface within one cycle is in contact, and stays so.
TEST(Containment, WhatGoesInStaysIn) {
  const auto scene =
      build({body("block", meshShape(boxMesh({0.2, 0.2, 0.2}))), body("bead", Primitive(Sphere{0.02}))}, coarse());
  Monitor monitor(scene, soft());
  Vector3d p(0.3, 0, 0);
  for (const double x : {0.25, 0.0, 0.01, 0.02, 0.3, 0.32}) {
    const Vector3d q(x, 0, 0);
    const Verdict verdict =
        monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {translation(p), translation(q)}}), {}).verdict;
    const bool outside = x > 0.22 && p.x() > 0.22;
    EXPECT_EQ(verdict, outside ? Verdict::kClear : Verdict::kContact) << x;
    p = q;
  }
}

/// A box whose lid (z) is smaller on all sides by the width of a crack.
TriangleMesh crackedBox(double half, double crack) {
  TriangleMesh box = binMesh(half);
  const double x = half - crack;
  addQuad(box, {Vector3d(-x, -x, half), {x, -x, half}, {x, x, half}, {-x, x, half}});
  return box;
}

/// Nothing comes through a crack: what is in the box is in contact until it comes out.
TEST(Containment, WhatIsInABoxWithACrackIsInContact) {
  const auto scene =
      build({body("box", meshShape(crackedBox(0.1, 2e-5))), body("bead", meshShape(boxMesh({0.003, 0.003, 0.003})))},
            coarse());
  ASSERT_TRUE(scene->bodies[0].doubtful);
  Monitor monitor(scene, soft());
  const auto verdictOf = [&](const Vector3d& start, const Vector3d& end) {
    return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {translation(start), translation(end)}}), {}).verdict;
  };
  const Vector3d inside(0.01, 0, 0), farther(0.02, 0.05, 0.01), outside(0.02, 0.2, 0.01), above(0.02, 0.2, 0.5);
  EXPECT_EQ(verdictOf(inside, farther), Verdict::kContact);
  EXPECT_EQ(verdictOf(outside, outside), Verdict::kClear) << "a jump";
  EXPECT_EQ(verdictOf(outside, above), Verdict::kClear);
  EXPECT_EQ(verdictOf(above, inside), Verdict::kContact) << "through the surface";
  EXPECT_EQ(verdictOf(inside, farther), Verdict::kContact);
  EXPECT_EQ(verdictOf(farther, outside), Verdict::kContact) << "through the surface";
}

/// Faces that are joined over a crack of some nanometres get no cap. What passes through it, a sheet without thickness,
/// comes nearer to them than they are moved when joined: so it is neither inside nor outside for ever.
TEST(Containment, WhatPassesThroughACrackIsNotedOnBothWays) {
  constexpr double kHalf = 0.1, kCrack = 1e-8;
  const TriangleMesh cracked = crackedBox(kHalf, kCrack);
  TriangleMesh sheet;
  addQuad(sheet, {Vector3d(0, -0.01, -0.01), {0, 0.01, -0.01}, {0, 0.01, 0.01}, {0, -0.01, 0.01}});
  const auto scene = build({body("box", meshShape(cracked)), body("sheet", meshShape(sheet))}, coarse());
  ASSERT_FALSE(scene->bodies[0].triangles->closed);
  const double slit = kHalf - 0.5 * kCrack;
  std::vector<Vector3d> way = {{0, 0, 0},      {0.02, 0, 0},    {slit, 0, 0},   {slit, 0, 0.08},
                               {slit, 0, 0.1}, {slit, 0, 0.12}, {slit, 0, 0.14}};
  for (const Verdict at_end : {Verdict::kClear, Verdict::kContact}) {
    Monitor monitor(scene, soft());
    Verdict verdict = Verdict::kUncertain;
    for (std::size_t i = 0; i + 1 < way.size(); ++i)
      verdict =
          monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {translation(way[i]), translation(way[i + 1])}}), {})
              .verdict;
    EXPECT_EQ(verdict, at_end);
    std::reverse(way.begin(), way.end());
  }
}

}  // namespace sdf_ccd::containment_test
