#include "monitor/pair_measure.h"

#include <gtest/gtest.h>

#include <chrono>

#include "oracle/box_union.h"
#include "oracle/drawn_meshes.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/monitor.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd::pair_measure_test {

using namespace test;

BodyOptions coarse() {
  BodyOptions options = fine(0.02);
  options.field.cells = 12;
  return options;
}

constexpr double kHalf = 0.05, kTop = 0.02;  // half sizes of a cube, and of the slab that it lands on [m]

/// Pose of a cube with a corner pointing down; kCorner is the distance of that corner from its centre [m].
Isometry3d onCorner() {
  return pose(Vector3d::Zero(), std::acos(1.0 / std::sqrt(3.0)), {1, -1, 0});
}
const double kCorner = std::sqrt(3.0) * kHalf;

struct Landing {
  Shape slab, cube;
  bool is_swapped;
};

std::vector<Landing> landings() {
  const Shape slab_mesh = meshShape(boxMesh({0.3, 0.3, kTop})),
              slab_box = Primitive(Box::fromSize({0.6, 0.6, 2.0 * kTop}));
  const Shape cube_mesh = meshShape(boxMesh({kHalf, kHalf, kHalf})),
              cube_box = Primitive(Box::fromSize({2.0 * kHalf, 2.0 * kHalf, 2.0 * kHalf}));
  return {{slab_mesh, cube_mesh, false},
          {slab_mesh, cube_mesh, true},
          {slab_box, cube_mesh, false},
          {slab_mesh, cube_box, true},
          {slab_box, cube_box, false}};
}

/// The edge of a board, which needs no shell against small bodies, is deep inside a ball.
TEST(PairMeasure, ALargeBodysSurfaceIsSearchedForInsideASmallOne) {
  const SceneDescription description{
      {body("board", Primitive(Box::fromSize({0.8, 0.3, 0.018})), true), body("ball", meshShape(icosphere(0.05, 4)))},
      {}};
  const BodyOptions options = optionsForContacts();
  const CycleMotion motion =
      cycle(0.1, {still(Isometry3d::Identity()), {translation({0.0131, 0.21, 0.0}), translation({0.0131, 0.17, 0.0})}});
  Monitor monitor(build({description.bodies[0], description.bodies[1]}, options), soft());
  const PairResult pair = monitor.run(motion, {}).pairs[0];
  EXPECT_TRUE(pair.measured);
  EXPECT_GE(pair.deepest.depth + pair.deepest.depth_error, 0.0298);  // of the mesh
  EXPECT_NEAR(pair.deepest.depth, 0.03, 3e-4);
  EXPECT_LT(pair.deepest.depth_error, 2e-4);
}

TEST(PairMeasure, DepthPlaceAndBeginOfALandingAreExact) {
  // From 6 mm above to 3 mm deep in 90 ms: the cube touches at 60 ms.
  for (const Landing& landing : landings()) {
    const BodyDescription slab = body("slab", landing.slab), cube = body("cube", landing.cube);
    const auto scene = landing.is_swapped ? build({cube, slab}, coarse()) : build({slab, cube}, coarse());
    Monitor monitor(scene, soft());
    const auto at = [](double height) { return translation({0.013, 0.021, kTop + kCorner + height}) * onCorner(); };
    std::vector<std::vector<Isometry3d>> poses{still(Isometry3d::Identity()), {at(0.006), at(-0.003)}};
    if (landing.is_swapped) std::swap(poses[0], poses[1]);
    CycleRequest request = {};
    request.max_points = 5;
    const PairResult& pair = monitor.run(cycle(0.09, poses), request).pairs[0];
    ASSERT_EQ(pair.verdict, Verdict::kContact);
    EXPECT_NEAR(pair.deepest.depth, 0.003, 1e-9);
    EXPECT_LE(pair.deepest.depth_error, 1e-4);
    EXPECT_LE(0.003, pair.deepest.depth + pair.deepest.depth_error);
    EXPECT_NEAR(pair.deepest.time, 0.09, 1e-12);
    EXPECT_NEAR((pair.deepest.p_W - Vector3d(0.013, 0.021, kTop - 0.003)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((pair.deepest.normal_W - Vector3d(0, 0, landing.is_swapped ? -1 : 1)).norm(), 0.0, 1e-6);
    ASSERT_TRUE(pair.first_touch);
    EXPECT_LE(pair.first_touch->enter, 0.06 + 1e-12);
    EXPECT_GE(pair.first_touch->exit, 0.06 - 1e-12);
    EXPECT_LE(pair.first_touch->exit - pair.first_touch->enter, 0.002);  // 0.2 mm of motion
    ASSERT_EQ(pair.intervals.size(), 1u);
    EXPECT_LE(pair.intervals[0].enter, pair.first_touch->exit);
    EXPECT_GE(pair.intervals[0].enter, pair.first_touch->enter);
    EXPECT_EQ(pair.intervals[0].exit, 0.09);
    EXPECT_EQ(pair.deepest.exit, 0.09);
  }
}

TEST(PairMeasure, AMarginIsNoErrorOfTheDepth) {
  constexpr double kMargin = 0.01, kDepth = 0.003;
  for (const double depth : {kDepth, -kDepth}) {  // the second is apart, by less than the margin
    const auto scene =
        build({body("slab", Primitive(Box::fromSize({0.6, 0.6, 2.0 * kTop}))), body("ball", Primitive(Sphere{kHalf}))},
              coarse());
    Monitor monitor(scene, soft());
    const Isometry3d ball = translation({0.013, 0.021, kTop + kHalf - depth});
    CycleRequest request = {};
    request.margin = kMargin;
    const PairResult& pair = monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {ball, ball}}), request).pairs[0];
    EXPECT_TRUE(pair.measured);
    EXPECT_NEAR(pair.deepest.depth, std::max(0.0, depth), 1e-5);
    EXPECT_LE(pair.deepest.depth_error, 1e-4);
    for (const ContactPoint& peak : pair.peaks) EXPECT_LE(peak.depth_error, 1e-4);
  }
}

/// While bodies rest, what was found for one error of their poses also answers for a larger one.
TEST(PairMeasure, ARestingContactsDepthHasTheErrorOfItsCycle) {
  const auto scene =
      build({body("slab", Primitive(Box::fromSize({0.6, 0.6, 2.0 * kTop}))), body("ball", Primitive(Sphere{kHalf}))},
            coarse());
  for (const double depth : {1e-4, 2e-4, 0.003}) {
    const Isometry3d ball = translation({0.013, 0.021, kTop + kHalf - depth});
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), {ball, ball}});
    for (const double margin : {0.0, 0.01}) {
      Monitor monitor(scene, soft());
      CycleRequest request = {};
      for (const double error : {3e-4, 3e-4, 3e-4, 3e-4, 5e-3, 1e-3, 3e-4}) {
        motion.motion_error = {0.0, error};
        request.margin = error > 3e-4 ? margin : 0.0;
        const PairResult& pair = monitor.run(motion, request).pairs[0];
        EXPECT_NEAR(pair.deepest.depth, depth, 1e-5);
        EXPECT_GE(pair.deepest.depth_error, error) << depth << " " << margin;
        EXPECT_LE(pair.deepest.depth_error, error + 1.1e-4) << depth << " " << margin;
      }
    }
  }
}

/// Boxes whose faces nearly coincide: of some slivers it is not certain whether they lie inside, as in many meshes of
/// robots.
TEST(PairMeasure, SliversOfUncertainSidesDoNotMatter) {
  Random random(5);
  int measured = 0;
  for (int i = 0; i < 30; ++i) {
    std::vector<OrientedBox> boxes;
    for (int k = 0; k < 3; ++k) boxes.push_back(boxAt(Vector3d(0.1 * k, 0.0, 0.05 * k), {0.1, 0.1, 0.1}));
    std::vector<OrientedBox> noisy = boxes;
    for (OrientedBox& box : noisy) box.X_WB = pose(random, 1e-8, 1e-8) * box.X_WB;
    const TriangleMesh mesh = meshOf(noisy);
    const SolidReport report = Solid(mesh).report();
    if (!(report.doubtful_area > 0.0) || report.doubtful_reach > 1e-5) continue;
    constexpr double kPin = 1e-4;  // half size [m]
    const auto scene =
        build({body("boxes", meshShape(mesh)), body("pin", Primitive(Box::fromSize(Vector3d::Constant(2.0 * kPin))))},
              coarse());
    Monitor monitor(scene, soft());
    const Vector3d p(uniform(random, 0.0, 0.2), 0.02, 0.08);
    const PairResult pair =
        monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation(p))}), {}).pairs.front();
    ASSERT_TRUE(pair.measured);
    EXPECT_NEAR(pair.deepest.depth, -distanceToUnion(boxes, p), 1.8 * kPin + pair.deepest.depth_error);
    EXPECT_LT(pair.deepest.depth_error, 1e-4);
    ++measured;
  }
  EXPECT_GT(measured, 3);
}

/// A cube swings past with an edge down, deepest halfway.
TEST(PairMeasure, FindsTheTurnOfATurnedMotion) {
  const auto scene = build(
      {body("slab", meshShape(boxMesh({0.3, 0.3, kTop}))), body("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))},
      coarse());
  Monitor monitor(scene, soft());
  constexpr double kArm = 0.2;
  const double edge = std::sqrt(2.0) * kHalf, reach = kArm + edge;
  for (const auto& [half_angle, depth] : {std::pair{0.01, 1e-5}, {0.1, 8e-4}}) {
    const Vector3d pivot(0, 0, kTop - depth + reach);
    const auto at = [&](double angle) {
      return translation(pivot) * pose({0, 0, 0}, angle, {0, 1, 0}) * translation({0, 0, -kArm}) *
             pose({0, 0, 0}, kPi / 4, {0, 1, 0});
    };
    monitor.reset();
    const CycleMotion motion = cycle(1.0, {still(Isometry3d::Identity()), {at(-half_angle), at(half_angle)}});
    const PairResult& pair = monitor.run(motion, {}).pairs[0];
    ASSERT_EQ(pair.verdict, Verdict::kContact);
    EXPECT_LE(pair.deepest.depth, depth + 1e-12);
    EXPECT_LE(depth, pair.deepest.depth + pair.deepest.depth_error);
    EXPECT_LE(pair.deepest.depth_error, 1e-4);
    // It touches when its edge, on a circle, reaches the top of the slab.
    const double angle = std::acos((reach - depth) / reach), begin = 0.5 - 0.5 * angle / half_angle;
    ASSERT_TRUE(pair.first_touch);
    EXPECT_LE(pair.first_touch->enter, begin + 1e-9);
    EXPECT_GE(pair.first_touch->exit, begin - 1e-9);
  }
}

TEST(PairMeasure, ContactDoesNotBeginBeforeTheBodiesTouch) {
  // Shells and fields report contact even before that, if points are close to each other.
  BodyOptions options = optionsForContacts(0.005);
  const auto scene = build(
      {body("ball", meshShape(icosphere(0.05, 2))), body("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))}, options);
  Monitor monitor(scene, soft());
  int touching = 0, is_cut = 0;
  for (int i = 0; i < 40; ++i) {
    const auto at = [&](double depth) {
      return translation({0.002 * i - 0.03, 0.001 * i, kHalf + 0.05 - depth}) * pose({0, 0, 0}, 0.1 * i, {1, 2, 3});
    };
    monitor.reset();
    const PairResult& pair =
        monitor.run(cycle(0.1, {{at(-0.01), at(0.002)}, still(Isometry3d::Identity())}), {}).pairs[0];
    if (!pair.first_touch) continue;
    ++touching;
    is_cut += pair.intervals[0].enter == pair.first_touch->enter;
    EXPECT_GE(pair.intervals[0].enter, pair.first_touch->enter) << i;
    EXPECT_GE(pair.deepest.time, pair.first_touch->enter) << i;
  }
  EXPECT_GT(touching, 20);
  EXPECT_GT(is_cut, 0);
}

TEST(PairMeasure, DoesNotLastWhileTheBodiesAreApart) {
  const auto scene = build(
      {body("a", meshShape(boxMesh({kHalf, kHalf, kHalf}))), body("b", meshShape(boxMesh({kHalf, kHalf, kHalf})))},
      optionsForContacts());
  Monitor monitor(scene, soft());
  const double edge = std::sqrt(2.0) * kHalf;
  const Isometry3d X_WA = pose({0, 0, 0}, kPi / 4, {1, 0, 0});
  const auto at = [&](double height) {
    return translation({0.0011, 0.0007, 2.0 * edge + height}) * pose({0, 0, 0}, kPi / 4, {0, 1, 0});
  };
  // Crossing edges touch briefly, 0.2 mm deep, away from all shell points; then they are 0.2 m apart.
  const CycleMotion motion =
      cycle(3.0, {std::vector<Isometry3d>(4, X_WA), {at(0.005), at(-2e-4), at(0.2), at(-0.008)}});
  const PairResult& pair = monitor.run(motion, {}).pairs[0];
  ASSERT_TRUE(pair.first_touch);
  EXPECT_NEAR(pair.first_touch->enter, 0.96, 0.03);
  ASSERT_GE(pair.intervals.size(), 2u);
  EXPECT_GE(pair.intervals[0].exit, pair.first_touch->exit);
  EXPECT_LT(pair.intervals[0].exit, 1.01);
  for (const Interval& interval : pair.intervals) EXPECT_FALSE(interval.enter < 1.5 && interval.exit > 1.5);
}

TEST(PairMeasure, OfWhatIsWithinAtFirstNothingIsCut) {
  const auto scene =
      build({body("block", meshShape(boxMesh({0.1, 0.1, 0.1}))), body("cube", meshShape(boxMesh({0.01, 0.01, 0.01})))},
            coarse());
  Monitor monitor(scene, soft());
  const PairResult& pair =
      monitor
          .run(cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, 0.06}), translation({0, 0, 0.13})}}), {})
          .pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  ASSERT_TRUE(pair.first_touch);
  EXPECT_EQ(pair.first_touch->exit, 0.0);
  ASSERT_FALSE(pair.intervals.empty());
  EXPECT_EQ(pair.intervals.front().enter, 0.0);
}

TEST(PairMeasure, OfWhatRestsFlatIsTight) {
  const auto scene = build(
      {body("slab", meshShape(boxMesh({0.3, 0.3, kTop}))), body("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))},
      coarse());
  Monitor monitor(scene, soft());
  const Isometry3d X = pose({0.03, 0.02, 0}, 0.7, {0, 0, 1});
  for (const double depth : {1e-5, 1e-3}) {
    const auto poses = still(translation({0, 0, kTop + kHalf - depth}) * X);
    const PairResult& pair = monitor.run(cycle(1e-3, {still(Isometry3d::Identity()), poses}), {}).pairs[0];
    ASSERT_EQ(pair.verdict, Verdict::kContact);
    EXPECT_NEAR(pair.deepest.depth, depth, 5e-5);  // the resolution
    EXPECT_LE(depth, pair.deepest.depth + pair.deepest.depth_error);
    EXPECT_LE(pair.deepest.depth_error, 1e-4);
    EXPECT_GT(pair.deepest.normal_W.z(), 0.999);
    ASSERT_TRUE(pair.first_touch);
    EXPECT_EQ(pair.first_touch->enter, 0.0);
  }
}

TEST(PairMeasure, WhatLiesInsideTouchesAllTheTime) {
  const auto scene =
      build({body("slab", meshShape(boxMesh({0.3, 0.3, 0.1}))), body("cube", meshShape(boxMesh({0.01, 0.01, 0.01})))},
            coarse());
  Monitor monitor(scene, soft());
  const PairResult& pair =
      monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, 0.06}))}), {}).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_NEAR(pair.deepest.depth, 0.05, 1e-9);  // its lower corners
  EXPECT_LE(pair.deepest.depth_error, 1e-4);
  ASSERT_TRUE(pair.first_touch && pair.last_touch);
  EXPECT_EQ(pair.first_touch->exit, 0.0);
  EXPECT_EQ(pair.last_touch->enter, 0.1);
}

TEST(PairMeasure, OnlyWhereBothBodiesHaveSolids) {
  const Shape slab = meshShape(boxMesh({0.3, 0.3, kTop}));
  const std::vector<std::vector<Isometry3d>> poses{still(Isometry3d::Identity()),
                                                   still(translation({0, 0, kTop + kHalf - 0.003}))};
  const auto run = [&](const Shape& other) {
    Monitor monitor(build({body("slab", slab), body("other", other)}, coarse()), soft());
    return monitor.run(cycle(0.1, poses), {}).pairs[0];
  };
  EXPECT_TRUE(run(meshShape(boxMesh({kHalf, kHalf, kHalf}))).first_touch);
  const Shape open = meshShape(openBox(Vector3d::Constant(-kHalf), Vector3d::Constant(kHalf)));
  const PairResult of_open = run(open);
  EXPECT_FALSE(of_open.measured);
  EXPECT_FALSE(of_open.first_touch);
  EXPECT_NE(of_open.verdict, Verdict::kClear);
  const auto with_half_space = run(Primitive(HalfSpace{})).first_touch;  // all of the slab is in it
  ASSERT_TRUE(with_half_space);
  EXPECT_EQ(with_half_space->enter, 0.0);
}

TEST(PairMeasure, OfRoundBodiesToo) {
  const auto scene =
      build({body("ball", Primitive(Sphere{0.03})), body("post", Primitive(Cylinder::fromRadiusAndLength(0.02, 0.2)))},
            coarse());
  Monitor monitor(scene, soft());
  const auto at = [](double depth) { return translation({0.05 - depth, 0, 0}); };
  const PairResult& pair =
      monitor.run(cycle(0.1, {{at(-0.002), at(0.002)}, still(Isometry3d::Identity())}), {}).pairs[0];
  ASSERT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_NEAR(pair.deepest.depth, 0.002, 1e-4);
  EXPECT_LE(0.002, pair.deepest.depth + pair.deepest.depth_error);
  EXPECT_LE(pair.deepest.depth_error, 2e-4);
  ASSERT_TRUE(pair.first_touch);
  EXPECT_NEAR(pair.first_touch->enter, 0.05, 0.003);
  EXPECT_GE(pair.first_touch->exit, 0.05 - 1e-3);
}

/// The ball's surface is deepest on the board's middle plane, wherever its centre is; or the board's surface in it.
TEST(PairMeasure, OfBallsWhoseCentreIsInsideToo) {
  struct Case {
    double radius, half, beside, depth;
  };
  for (const auto& [radius, half, beside, depth] : std::vector<Case>{{0.02, 0.02, 0.003, 0.02},
                                                                     {0.02, 0.02, 0.01, 0.02},
                                                                     {0.05, 0.005, 0.0, 0.045},
                                                                     {0.2, 0.02, 0.0, 0.18},
                                                                     {0.03, 0.1, 0.02, 0.1}}) {
    const std::vector<Shape> boards = {Primitive(Box::fromSize({1.0, 1.0, 2.0 * half})),
                                       meshShape(boxMesh({0.5, 0.5, half}))};
    for (const Shape& board : boards) {
      Monitor monitor(build({body("board", board), body("ball", Primitive(Sphere{radius}))}, coarse()), soft());
      const auto poses = still(translation({0.1, 0.05, beside}));
      const PairResult& pair = monitor.run(cycle(0.1, {still(Isometry3d::Identity()), poses}), {}).pairs[0];
      EXPECT_EQ(pair.verdict, Verdict::kContact);
      EXPECT_NEAR(pair.deepest.depth, depth, 2e-4) << radius << " in " << half << " at " << beside;
      EXPECT_GE(pair.deepest.depth + pair.deepest.depth_error, depth - 1e-9);
      EXPECT_LE(pair.deepest.depth_error, 2e-4) << radius << " in " << half << " at " << beside;
    }
  }
}

/// All of a ball that flies through a thin plate is as deep in the plate at some time; the plate is deeper in the ball.
TEST(PairMeasure, OfWhatFliesThroughAThinPlateIsQuick) {
  const auto scene = build(
      {body("plate", Primitive(Box::fromSize({0.001, 2.0, 0.2}))), body("ball", Primitive(Sphere{0.05}))}, coarse());
  Monitor monitor(scene, soft());
  CycleRequest request;
  request.wrenches = false;
  const auto start = std::chrono::steady_clock::now();
  const PairResult& pair = monitor
                               .run(cycle(0.02, {still(Isometry3d::Identity()),
                                                 {translation({-0.2, 0.013, 0}), translation({0.2, 0.013, 0})}}),
                                    request)
                               .pairs[0];
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 0.05);
  EXPECT_NEAR(pair.deepest.depth, 0.05, pair.deepest.depth_error);
  EXPECT_LT(pair.deepest.depth_error, 1e-4);
}

TEST(PairMeasure, BoundsOnlyTheContactWithTheDeepestPoint) {
  BodyDescription posts = body("posts", Primitive(Box::fromSize({0.06, 0.06, 0.2})));
  posts.geometry.push_back({Primitive(Box::fromSize({0.06, 0.06, 0.2})), translation({0.3, 0, 0}), "second"});
  const auto scene = build({posts, body("tool", Primitive(Box::fromSize({0.04, 0.04, 0.04})))}, optionsForContacts());
  Monitor monitor(scene, {});
  const CycleMotion motion =
      cycle(1.0, {still(Isometry3d::Identity()), {translation({-0.1, 0.048, 0}), translation({0.4, 0.028, 0})}});
  ContactTracker tracker(*scene);
  tracker.update({monitor.run(motion, {}), motion, motion.times, std::chrono::seconds(1000)});
  ASSERT_EQ(tracker.size(), 2u);
  EXPECT_NEAR(tracker[0].deepest.depth, 0.0077, 1e-3);
  EXPECT_LT(tracker[0].deepest.depth_error, 1e-3);
  EXPECT_NEAR(tracker[1].deepest.depth, 0.0192, 2e-3);
}

/// Tori in nearly the same place have no few deepest places; a search that ends early has looked at both surfaces.
TEST(PairMeasure, ASearchThatEndsEarlyKnowsBothSurfaces) {
  const TriangleMesh torus = torusMesh(0.1, 0.02, 80, 25);
  Monitor monitor(build({body("a", meshShape(torus)), body("b", meshShape(torus))}, optionsForContacts()), soft());
  const Isometry3d X = translation({0, 0, 0.002});
  const PairResult pair = monitor.run(cycle(0.01, {still(Isometry3d::Identity()), still(X)}), {}).pairs.front();
  ASSERT_TRUE(pair.measured);
  EXPECT_LT(pair.deepest.depth_error, 2e-3);
}

}  // namespace sdf_ccd::pair_measure_test
