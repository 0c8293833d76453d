#include <array>

#include <gtest/gtest.h>

#include "mesh/mesh_edges.h"
#include "monitor/surface_pair_case.h"
#include "oracle/random.h"
#include "scene/body_triangles.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::surface_pair_test {

using namespace test;

/// Independent of fields and shells: boxes, balls, cylinders and meshes.
TEST(SurfacePair, TellsATenthOfAMillimetre) {
  constexpr double kGap = 5e-5, kHalf = 0.1;
  const std::vector<std::pair<Shape, double>> shapes = {
      {Primitive(Box::fromSize({2.0 * kHalf, 2.0 * kHalf, 2.0 * kHalf})), kHalf},
      {Primitive(Sphere{kHalf}), kHalf},
      {Primitive(Cylinder::fromRadiusAndLength(kHalf, 2.0 * kHalf)), kHalf},
      {meshShape(boxMesh({kHalf, kHalf, kHalf})), kHalf}};
  for (const auto& [shape, half] : shapes) {
    const auto scene =
        build({body("slab", Primitive(Box::fromSize({0.6, 0.6, 0.02}))), body("thing", shape)}, coarse());
    ASSERT_TRUE(scene->bodies[0].triangles && scene->bodies[1].triangles);
    Monitor monitor(scene, soft());
    const PairResult apart = at(monitor, translation({0.02, 0.03, 0.01 + half + kGap}));
    EXPECT_EQ(apart.verdict, Verdict::kClear);
    EXPECT_LE(apart.clearance, kGap);
    EXPECT_GT(apart.clearance, 0.2 * kGap);
    EXPECT_LT(apart.error.total(), 1e-5);
    EXPECT_EQ(at(monitor, translation({0.02, 0.03, 0.01 + half - kGap})).verdict, Verdict::kContact);
    // A cylinder on its side.
    if (half == kHalf && std::holds_alternative<Primitive>(shape)) {
      const Isometry3d lying = translation({0, 0, 0.01 + half + kGap}) * pose({0, 0, 0}, kPi / 2, {1, 0, 0});
      EXPECT_EQ(at(monitor, lying).verdict, Verdict::kClear);
      EXPECT_EQ(at(monitor, translation({0, 0, -2 * kGap}) * lying).verdict, Verdict::kContact);
    }
  }
}

/// A ball and a cube in the cavity of a closed mesh, which no ray leaves: whatever the fields' accuracy, the triangles
/// alone tell that neither is in the wall.
TEST(SurfacePair, InAClosedCavityItIsClear) {
  constexpr double kCavity = 0.11, kHalf = 0.1;
  const TriangleMesh hollow = merged(boxMesh({0.2, 0.2, 0.2}), [&] {
    TriangleMesh cavity = boxMesh({kCavity, kCavity, kCavity});
    for (Vector3i& t : cavity.triangles) std::swap(t[0], t[1]);
    return cavity;
  }());
  BodyDescription housing = body("housing", meshShape(hollow));
  housing.geometry.push_back({Primitive(Box::fromSize({0.1, 0.1, 0.1})), translation({0, 0, 0.4}), "lid", false});
  for (const double cell : {16.0, 64.0}) {
    BodyOptions options = coarse();
    options.field.cells = static_cast<int>(cell);
    for (const auto& [name, shape] : {std::pair("ball", Shape(Primitive(Sphere{kHalf}))),
                                      std::pair("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))}) {
      const auto scene = build({housing, body("thing", shape)}, options);
      Monitor monitor(scene, soft());
      for (const double gap : {0.01, 1e-3, 2e-4}) {
        const PairResult pair = at(monitor, translation({kCavity - kHalf - gap, 0, 0}));
        EXPECT_EQ(pair.verdict, Verdict::kClear) << name << ' ' << gap;
        EXPECT_LE(pair.clearance, gap);
        EXPECT_LT(pair.error.total(), 1e-5);
      }
      EXPECT_EQ(at(monitor, translation({kCavity - kHalf + 2e-4, 0, 0})).verdict, Verdict::kContact) << name;
    }
    // In the wall, where no surfaces cross.
    const auto scene = build({housing, body("bead", Primitive(Sphere{0.01}))}, options);
    Monitor monitor(scene, soft());
    EXPECT_EQ(at(monitor, translation({0.155, 0, 0})).verdict, Verdict::kContact);
    EXPECT_EQ(at(monitor, translation({0, 0, 0.4})).verdict, Verdict::kContact);
    EXPECT_EQ(at(monitor, translation({0.09, 0.09, 0.09})).verdict, Verdict::kClear);
  }
}

/// Also a tank of 50 m, whose sides are chords.
TEST(SurfacePair, LargeCylindersKeepMaxError) {
  for (const double radius : {0.5, 5.0, 25.0}) {
    const auto scene = build(
        {body("tank", Primitive(Cylinder::fromRadiusAndLength(radius, 2.0))), body("ball", Primitive(Sphere{0.1}))},
        fine(0.2));
    Monitor monitor(scene, soft());
    for (const double angle : {0.0, 0.001, 1.234}) {
      const auto beside = [&](double gap) {
        return translation((radius + 0.1 + gap) * Vector3d(std::cos(angle), std::sin(angle), 0.0));
      };
      EXPECT_EQ(at(monitor, beside(1.2e-4)).verdict, Verdict::kClear) << radius;
      EXPECT_EQ(at(monitor, beside(-1.2e-4)).verdict, Verdict::kContact) << radius;
    }
  }
}

/// A cube tumbles over a slab and is nearest with its edge, halfway, at a known distance. The bound holds from both
/// sides, for every max_error.
TEST(SurfacePair, WhatMayStayOpenFollowsMaxError) {
  constexpr double kHalf = 0.1, kTop = 0.01;
  const auto scene = build({body("slab", Primitive(Box::fromSize({1.0, 1.0, 2.0 * kTop}))),
                            body("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))},
                           coarse());
  Random random(3);
  for (const double max_error : {1e-5, 1e-4, 1e-3, 1e-2}) {
    MonitorOptions options = soft();
    options.max_error = max_error;
    Monitor monitor(scene, options);
    int open = 0;
    for (int i = 0; i < 200; ++i) {
      const double gap = max_error * (i % 2 == 0 ? 1.0 : 1e-3) * uniform(random, -4.0, 2.0),
                   from = uniform(random, -0.3, 0.3);
      const Isometry3d over = translation({0.1, -0.05, kTop + kHalf * std::sqrt(2.0) + gap});
      const auto at = [&](double angle) { return over * pose({0, 0, 0}, angle, {0, 1, 0}); };
      monitor.reset();
      const PairResult pair =
          monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {at(from), at(from + 1.5)}}), {}).pairs[0];
      const bool is_clear = pair.verdict == Verdict::kClear;
      ASSERT_TRUE(gap > 0.0 ? pair.verdict != Verdict::kContact : !is_clear) << max_error << ' ' << gap;
      ASSERT_TRUE(is_clear || gap <= max_error) << max_error << ' ' << gap;
      if (is_clear) {
        EXPECT_LT(pair.error.total(), 1e-9);
      }
      if (pair.verdict != Verdict::kUncertain) continue;
      ++open;
      ASSERT_LE(gap, pair.error.total());
      ASSERT_NEAR(pair.error.total(), max_error, 1e-9);
    }
    EXPECT_LT(open, 20) << max_error;  // within a fiftieth of the resolution, or rounding
  }
  for (const double wrong : {0.0, -1.0, 9e-6, 0.011, std::nan("")}) {
    MonitorOptions options;
    options.max_error = wrong;
    EXPECT_THROW(Monitor(scene, options), std::invalid_argument) << wrong;
  }
}

/// A ball passes another one, and a cube tumbles over a slab, by a few micrometres.
TEST(SurfacePair, WhatGrazesByFarLessThanMaxErrorIsDecided) {
  constexpr double kRadius = 0.05, kHalf = 0.1, kTop = 0.01;
  const auto balls =
      build({body("ball", Primitive(Sphere{kRadius})), body("other", Primitive(Sphere{kRadius}))}, coarse());
  const auto cube = build({body("slab", Primitive(Box::fromSize({1.0, 1.0, 2.0 * kTop}))),
                           body("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))},
                          coarse());
  Monitor of_balls(balls, soft()), of_cube(cube, soft());
  Random random(4);
  const auto verdict = [](Monitor& monitor, const Isometry3d& from, const Isometry3d& to) {
    monitor.reset();
    return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {from, to}}), {}).pairs[0].verdict;
  };
  for (int i = 0; i < 200; ++i) {
    const double gap = (i % 2 == 0 ? 1.0 : -1.0) * uniform(random, 3e-6, 1e-5), along = uniform(random, 0.005, 0.05);
    const Verdict expected = gap > 0.0 ? Verdict::kClear : Verdict::kContact;
    const Vector3d beside(0.0, 2.0 * kRadius + gap, 0.0), way(along, 0.0, 0.0);
    const double start = uniform(random, 0.1, 0.9);
    EXPECT_EQ(verdict(of_balls, translation(beside - start * way), translation(beside + (1.0 - start) * way)), expected)
        << "balls, " << gap << ", " << along;
    const Isometry3d over = translation({0.1, -0.05, kTop + kHalf * std::sqrt(2.0) + gap});
    const double from = kPi / 4 - start * along;
    EXPECT_EQ(
        verdict(of_cube, over * pose({0, 0, 0}, from, {0, 1, 0}), over * pose({0, 0, 0}, from + along, {0, 1, 0})),
        expected)
        << "cube, " << gap << ", " << along;
  }
}

/// The triangles detect contacts at the gap-closing caps of an almost closed mesh, however coarse the fields are.
TEST(SurfacePair, TellsATenthOfAMillimetreThroughCracks) {
  constexpr double kGap = 5e-5, kCrack = 1e-6, kHalf = 0.1;
  Random random(1);
  const TriangleMesh whole = boxMesh({kHalf, kHalf, kHalf});
  TriangleMesh cracked;
  for (const Vector3i& t : whole.triangles) {
    const int first = static_cast<int>(cracked.vertices.size());
    for (int k = 0; k < 3; ++k) cracked.vertices.push_back(whole.vertices[t[k]] + kCrack * direction(random));
    cracked.triangles.emplace_back(first, first + 1, first + 2);
  }
  const auto scene =
      build({body("slab", Primitive(Box::fromSize({0.6, 0.6, 0.02}))), body("cracked", meshShape(cracked))}, coarse());
  Monitor monitor(scene, soft());
  EXPECT_EQ(at(monitor, translation({0.02, 0.03, 0.01 + kHalf + kGap})).verdict, Verdict::kClear);
  EXPECT_EQ(at(monitor, translation({0.02, 0.03, 0.01 + kHalf - kGap})).verdict, Verdict::kContact);
}

/// If contacts are not requested, verdicts are the same, and a crossing has a time and a position.
TEST(SurfacePair, VerdictsAloneAreTheSame) {
  const auto scene = build(
      {body("slab", Primitive(Box::fromSize({0.6, 0.6, 0.02}))), body("hand", meshShape(boxMesh({0.03, 0.04, 0.05}))),
       body("ball", Primitive(Sphere{0.04})), body("drum", Primitive(Cylinder::fromRadiusAndLength(0.03, 0.1)))},
      coarse());
  Monitor all(scene, soft()), verdicts(scene, soft());
  CycleRequest alone;
  alone.wrenches = alone.contacts = false;
  Random random(2);
  int contacts = 0;
  std::vector<Isometry3d> from(4, Isometry3d::Identity());
  for (int i = 0; i < 300; ++i) {
    std::vector<std::vector<Isometry3d>> motions = {still(Isometry3d::Identity())};
    for (int body = 1; body < 4; ++body) {
      const Isometry3d to = i % 10 == 0 ? pose(random, 3.0, 0.15) : from[body] * pose(random, 0.2, 0.01);
      motions.push_back({i % 10 == 0 ? to : from[body], to});
      from[body] = to;
    }
    const CycleMotion motion = cycle(0.1, motions);
    const CycleResult &expected = all.run(motion, {}), &result = verdicts.run(motion, alone);
    for (std::size_t k = 0; k < result.pairs.size(); ++k) {
      const PairResult& pair = result.pairs[k];
      EXPECT_EQ(pair.verdict, expected.pairs[k].verdict) << i << ", pair " << k;
      if (pair.verdict != Verdict::kContact) continue;
      ++contacts;
      ASSERT_FALSE(pair.intervals.empty());
      EXPECT_GE(pair.intervals[0].enter, 0.0);
      EXPECT_LE(pair.intervals[0].exit, 0.1);
    }
  }
  EXPECT_GT(contacts, 100);
}

/// Detects contacts that exist only within the cycle, however thin and fast the bodies are.
TEST(SurfacePair, NothingTunnels) {
  const auto scene = build(
      {body("plate", meshShape(boxMesh({0.1, 0.1, 0.0005}))), body("hand", meshShape(boxMesh({0.03, 0.04, 0.05})))},
      coarse());
  Monitor monitor(scene, soft());
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Isometry3d turn(pose(random, 3.0, 0.0).linear());
    const Vector3d aside(uniform(random, -0.05, 0.05), uniform(random, -0.05, 0.05), 0);
    monitor.reset();
    const CycleResult& result = monitor.run(cycle(0.1, {still(Isometry3d::Identity()),
                                                        {translation(aside + Vector3d(0, 0, 0.5)) * turn,
                                                         translation(aside - Vector3d(0, 0, 0.4)) * turn}}),
                                            {});
    EXPECT_EQ(result.verdict, Verdict::kContact) << i;
  }
}

TEST(SurfacePair, WhatIsSaidToBeVoxelsAndIsNotIsNotChecked) {
  BodyDescription map = body("map", meshShape(boxMesh({0.1, 0.1, 0.15})), true);
  map.geometry[0].watertight_voxels = true;
  const auto scene = build({map, body("ball", Primitive(Sphere{0.05}))}, coarse());
  EXPECT_NE(scene->bodies[0].failure.find("not those of whole voxels"), std::string::npos) << scene->bodies[0].failure;
  EXPECT_EQ(Monitor(scene, soft())
                .run(cycle(0.1, {still(translation({2, 0, 0})), still(Isometry3d::Identity())}), {})
                .verdict,
            Verdict::kNotChecked);
}

/// Bricks whose sides are flush: no edge of one pierces a face of the other.
TEST(SurfacePair, FlushBricksInEachOtherAreInContact) {
  for (const bool mesh : {false, true}) {
    const Primitive box = Box::fromSize({0.2, 0.2, 0.2});
    const Shape shape = mesh ? meshShape(boxMesh({0.1, 0.1, 0.1})) : Shape(box);
    const auto scene = build({body("a", shape), body("b", shape)}, coarse());
    const auto at = [&](double height) {
      return Monitor(scene, soft())
          .run(cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, height}))}), {})
          .verdict;
    };
    EXPECT_EQ(at(0.1), Verdict::kContact);
    EXPECT_EQ(at(0.199), Verdict::kContact);
    EXPECT_EQ(at(0.2), Verdict::kUncertain);
    EXPECT_EQ(at(0.201), Verdict::kClear);
  }
}

/// A closed channel along x, open at its top, whose floor is between z = 0 and `wall`.
TriangleMesh channel(double half_length, double half_width, double height, double wall) {
  const std::vector<Eigen::Vector2d> outline = {
      {-half_width, 0.0},        {half_width, 0.0},         {half_width, height},        {half_width - wall, height},
      {half_width - wall, wall}, {wall - half_width, wall}, {wall - half_width, height}, {-half_width, height}};
  TriangleMesh mesh;
  for (const double x : {-half_length, half_length})
    for (const Eigen::Vector2d& p : outline) mesh.vertices.emplace_back(x, p.x(), p.y());
  const auto quad = [&mesh](int a, int b, int c, int d) {
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(a, c, d);
  };
  constexpr int kCorners = 8;
  for (int i = 0; i < kCorners; ++i) {
    const int next = (i + 1) % kCorners;
    quad(i, i + kCorners, next + kCorners, next);
  }
  // The ends: floor and walls.
  const std::vector<std::array<int, 4>> faces = {{0, 1, 4, 5}, {1, 2, 3, 4}, {0, 5, 6, 7}};
  for (const auto& [a, b, c, d] : faces) {
    quad(a, d, c, b);
    quad(a + kCorners, b + kCorners, c + kCorners, d + kCorners);
  }
  return orientOutward(mesh).mesh;
}

/// The fields' error is centimetres, and the part nowhere farther from the link than that.
TEST(SurfacePair, AThinPartInARecessOfALargeLinkIsClear) {
  const TriangleMesh link = channel(1.0, 0.15, 0.3, 0.02);
  ASSERT_TRUE(isClosed(link));
  const auto scene = build({body("link", meshShape(link)), body("plate", Primitive(Box::fromSize({0.1, 0.1, 0.004})))},
                           optionsForContacts());
  Monitor monitor(scene, {});
  const PairResult above = at(monitor, translation({0.1, 0.0, 0.025}));
  EXPECT_EQ(above.verdict, Verdict::kClear) << above.error.total();
  EXPECT_GT(above.clearance, 0.0);
  EXPECT_LE(above.clearance, 0.003);
  EXPECT_NE(at(monitor, translation({0.1, 0.0, 0.01})).verdict, Verdict::kClear);  // inside the floor
}

/// The nearest triangles of the last query are far from those of the next.
TEST(SurfacePair, AJumpDoesNotLeaveAClearPairUncertain) {
  const Shape can = Primitive(Cylinder::fromRadiusAndLength(0.05, 0.2));
  const auto scene = build({body("a", can), body("b", can)}, optionsForContacts());
  const Isometry3d rest = Isometry3d::Identity(), beside = pose({0.105, 0.0, 0.0}, 0.6, {1, 0, 0});  // 5 mm apart
  Random random(3);
  Monitor monitor(scene, {});
  for (int i = 0; i < 200; ++i) {
    const Vector3d aside = 0.25 * direction(random);
    monitor.run(
        cycle(0.1, {still(rest), still(translation(aside) * pose({0, 0, 0}, uniform(random, 0, 3), {1, 0, 0}))}), {});
    const PairResult result = monitor.run(cycle(0.1, {still(rest), still(beside)}), {}).pairs[0];
    ASSERT_EQ(result.verdict, Verdict::kClear) << i << " " << aside.transpose() << " " << result.error.total();
  }
}

/// Rounding at 10⁹ m exceeds the resolution: halving the time then never ends by it.
TEST(SurfacePair, WhatRoundingCannotTellEnds) {
  const auto far = [](const std::string& name) {
    BodyDescription ball = body(name, Primitive(Sphere{0.1}));
    ball.geometry[0].X_BG.translation().x() = 9e8;
    return ball;
  };
  Monitor monitor(build({far("a"), far("b")}, optionsForContacts()), soft());
  const Verdict verdict = at(monitor, translation({0.0, 0.0, 0.20003})).verdict;
  EXPECT_NE(verdict, Verdict::kContact);
}

}  // namespace sdf_ccd::surface_pair_test
