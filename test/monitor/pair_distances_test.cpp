#include "sdf_ccd/distances.h"

#include <gtest/gtest.h>

#include <cmath>

#include "mesh/corners.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "oracle/triangle_distance.h"

namespace sdf_ccd::pair_distances_test {

using test::Random;
using test::Real;
using test::uniform;
using test::Vector3r;

constexpr double kRange = 0.3;

/// Exact distance of two boxes, from their faces.
double boxDistance(const Vector3d& half_a, const Isometry3d& X_WA, const Vector3d& half_b, const Isometry3d& X_WB) {
  const TriangleMesh a = test::boxMesh(half_a), b = test::boxMesh(half_b);
  Real least = 1e300L;
  for (int i = 0; i < int(a.triangles.size()); ++i)
    for (int k = 0; k < int(b.triangles.size()); ++k)
      least = std::min(least,
                       test::triangleDistance(test::exact(cornersOf(a, i), X_WA), test::exact(cornersOf(b, k), X_WB)));
  return static_cast<double>(least);
}

class PairDistancesTest : public ::testing::Test {
 protected:
  PairDistancesTest()
      : scene_(test::build({test::body("box", Primitive(Box::fromSize(2.0 * kBox))),
                            test::body("block", Primitive(Box::fromSize(2.0 * kBlock)), true),
                            test::body("ball", Primitive(Sphere{kRadius})), test::body("ground", test::ground(), true)},
                           test::fine(0.005))),
        monitor_(scene_, test::soft()),
        distances_(scene_) {}

  const std::vector<PairDistance>& cycle(const std::vector<Isometry3d>& from, const std::vector<Isometry3d>& to) {
    CycleMotion motion;
    motion.times = {0.0, 0.1};
    for (std::size_t b = 0; b < to.size(); ++b) motion.X_WB.push_back({from[b], to[b]});
    return update(motion);
  }

  /// Runs a cycle that starts where the last one ended.
  const std::vector<PairDistance>& update(const CycleMotion& motion) {
    result_ = monitor_.run(motion, {true, 3});
    const auto origin = std::chrono::nanoseconds(std::llround(1e9 * end_));
    end_ += motion.times.back();
    return distances_.update(motion, result_, kRange, {origin});
  }

  /// A motion in which all pairs are delayed.
  static CycleMotion delayed(const Scene& scene, const std::vector<Isometry3d>& at, double length) {
    CycleMotion motion;
    motion.times = {0.0, length};
    for (const Isometry3d& X : at) motion.X_WB.push_back({X, X});
    motion.spans.assign(scene.pairs.size(), {0, 0});
    return motion;
  }

  static const Vector3d kBox, kBlock;
  static constexpr double kRadius = 0.1;

  std::shared_ptr<const Scene> scene_;
  Monitor monitor_;
  PairDistances distances_;
  CycleResult result_;
  double end_ = 0.0;  // end of the last cycle [s]
};

const Vector3d PairDistancesTest::kBox(0.1, 0.05, 0.08), PairDistancesTest::kBlock(0.05, 0.3, 0.2);

TEST_F(PairDistancesTest, AreTrueWithWitnessesOnBothBodiesAndNothingNearIsLeftOut) {
  Random random(5);
  int near = 0, left_out = 0, of_ground = 0;
  std::vector<Isometry3d> last;
  for (int i = 0; i < 400; ++i) {
    // Small steps, with a large one now and then.
    const std::vector<Isometry3d> now =
        last.empty() || i % 50 == 0
            ? std::vector<Isometry3d>{test::translation({0.5, 0, 0.5}) * test::pose(random, 3.0, 0.4),
                                      test::translation({0, 0, 0.5}), test::translation({-0.4, 0, 0.6}),
                                      Isometry3d::Identity()}
            : std::vector<Isometry3d>{last[0] * test::pose(random, 0.05, 0.03), last[1],
                                      last[2] * test::pose(random, 0.05, 0.03), last[3]};
    const auto& found = cycle(last.empty() ? now : last, now);
    last = now;
    for (std::size_t p = 0; p < scene_->pairs.size(); ++p) {
      const PlannedPair& pair = scene_->pairs[p];
      const std::string names = scene_->bodies[pair.body_a].name + " " + scene_->bodies[pair.body_b].name;
      double truth = 0.0;
      const Vector3d ball = now[2].translation();
      if (names == "box block") {
        truth = boxDistance(kBox, now[0], kBlock, now[1]);
      } else if (names == "box ball" || names == "block ball") {
        const Vector3d half = names == "box ball" ? kBox : kBlock;
        const Vector3d p_B = now[names == "box ball" ? 0 : 1].inverse() * ball;
        truth = std::max(0.0, (p_B.cwiseAbs() - half).cwiseMax(0.0).norm() - kRadius);
      } else if (names == "ball ground") {
        truth = std::max(0.0, ball.z() - kRadius);
      } else {
        truth = 1e300;
        for (const Vector3d& corner : test::boxMesh(kBox).vertices) truth = std::min(truth, (now[0] * corner).z());
        truth = std::max(0.0, truth);
      }
      const auto of_pair = std::find_if(found.begin(), found.end(),
                                        [&](const PairDistance& each) { return each.pair == static_cast<int>(p); });
      if (of_pair == found.end()) {
        EXPECT_GT(truth, kRange - 1e-9) << names;
        ++left_out;
        continue;
      }
      ++near;
      of_ground += names.find("ground") != std::string::npos;
      EXPECT_LE(std::abs(of_pair->distance - truth), of_pair->error + 1e-9) << names << " " << truth;
      EXPECT_LE(of_pair->any.width, truth + 1e-9);
      if (result_.pairs[p].verdict != Verdict::kClear) continue;
      EXPECT_LT(of_pair->error, 1e-4) << names;
      EXPECT_NEAR((of_pair->p_B_W - of_pair->p_A_W).norm(), of_pair->distance, 1e-6) << names;
      EXPECT_NEAR(((of_pair->p_B_W - of_pair->p_A_W) / of_pair->distance - of_pair->normal_W).norm(), 0.0, 1e-6);
      if (of_pair->slab) {
        EXPECT_LE(of_pair->slab->width, truth + 1e-9) << names;
      }
    }
  }
  EXPECT_GT(near, 300);
  EXPECT_GT(left_out, 100);
  EXPECT_GT(of_ground, 15);
}

TEST_F(PairDistancesTest, SpeedsAreThoseAtWhichTheyClose) {
  const std::vector<Isometry3d> rest = {test::translation({0.4, 0, 0.5}), test::translation({0, 0, 0.5}),
                                        test::translation({-2, 0, 1.5}), Isometry3d::Identity()};
  std::vector<Isometry3d> moved = rest;
  moved[0] = test::translation({0.37, 0.01, 0.5});
  cycle(rest, rest);
  const auto& found = cycle(rest, moved);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 0.22, 1e-9);
  EXPECT_NEAR(found[0].closing_speed, 0.3, 1e-9);
  EXPECT_NEAR(found[0].any.closing, std::hypot(0.3, 0.1), 1e-6);
  EXPECT_EQ(found[0].any.over, 0.1);
  ASSERT_TRUE(found[0].slab);
  EXPECT_NEAR(found[0].slab->closing, 0.3, 1e-6);
  const auto& back = cycle(moved, rest);
  EXPECT_NEAR(back[0].slab->closing, -0.3, 1e-6);
  CycleMotion motion;
  motion.times = {0.0, 0.1};
  for (const Isometry3d& X : rest) motion.X_WB.push_back({X, X});
  const auto over = [&](const std::vector<double>& gaps) {  // poses are interpolated over these times
    const auto& between = distances_.update(motion, monitor_.run(motion, {true, 3}), kRange, {{}, &gaps});
    EXPECT_EQ(between[0].slab->over, between[0].any.over);
    return between[0].any.over;
  };
  EXPECT_EQ(over({0.1, 0.1, 0.0, 0.0}), 0.1);  // both have moved from sample to sample
  EXPECT_EQ(over({0.25, 0.0, 0.0, 0.0}), 0.25);
  EXPECT_EQ(over({0.25, 0.15, 0.0, 0.0}), 0.4);
}

/// Steps below those at which a pair is measured again must not add up, also if both bodies move together.
TEST_F(PairDistancesTest, BodiesThatHardlyMoveAreTrueStill) {
  constexpr double kStep = 4e-10;
  std::vector<Isometry3d> X_WB(4, Isometry3d::Identity());
  X_WB[2] = test::translation({5, 5, 5});
  X_WB[3] = test::translation({0, 0, -5});
  for (int k = 0; k < 200; ++k) {
    const std::vector<Isometry3d> before = X_WB;
    const Isometry3d X_all = test::pose({0.01 * k, -0.02 * k, 0.03}, 0.05 * k, {0, 0, 1});
    X_WB[1] = X_all;
    X_WB[0] = X_all * test::pose({kBox.x() + kBlock.x() + 0.1 - kStep * k, 0.01, 0.02}, 0.3, {1, 2, 3});
    const std::vector<PairDistance>& near = cycle(k == 0 ? X_WB : before, X_WB);
    ASSERT_EQ(near.size(), 1u);
    const double truth = boxDistance(kBox, X_WB[0], kBlock, X_WB[1]);
    ASSERT_LE(std::abs(near[0].distance - truth), near[0].error);
    ASSERT_LE(std::abs(near[0].distance - truth), 1.1e-9);
    ASSERT_NEAR((near[0].p_A_W - near[0].p_B_W).norm(), truth, 2e-9);
    ASSERT_LT((X_WB[0].inverse() * near[0].p_A_W).cwiseAbs().maxCoeff(), kBox.maxCoeff() + 1e-9);
  }
}

TEST_F(PairDistancesTest, WhatTouchesHasNone) {
  const std::vector<Isometry3d> touch = {test::translation({0.14, 0, 0.5}), test::translation({0, 0, 0.5}),
                                         test::translation({-2, 0, 1.5}), Isometry3d::Identity()};
  const auto& found = cycle(touch, touch);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].distance, 0.0);
  EXPECT_EQ(found[0].any.width, 0.0);
  // A body wholly inside touches no surface.
  const std::vector<Isometry3d> inside = {touch[0], touch[1], test::translation({0, 0, 0.5}), touch[3]};
  for (const PairDistance& each : cycle(inside, inside)) EXPECT_EQ(each.any.width, 0.0) << each.pair;
}

/// However near the surfaces, compared with the errors of fields.
TEST_F(PairDistancesTest, WhatIsInsideAThinBodyTouchesIt) {
  const auto sheet = test::meshShape(test::boxMesh({0.5, 0.3, 0.01})),
             bead = test::meshShape(test::boxMesh({0.003, 0.003, 0.003}));
  for (const bool has_ground : {false, true}) {
    BodyDescription outer = has_ground ? test::body("outer", test::ground()) : test::body("outer", sheet);
    const auto scene = test::build({outer, test::body("bead", bead)}, test::fine(0.05));
    Monitor monitor(scene, test::soft());
    PairDistances distances(scene);
    const CycleMotion motion =
        test::cycle(0.1, {test::still(Isometry3d::Identity()),
                          {test::translation({0.1, 0.1, -0.005}), test::translation({0.12, 0.1, -0.005})}});
    const CycleResult result = monitor.run(motion, {});
    ASSERT_EQ(result.verdict, Verdict::kContact);
    const PairDistance found = distances.update(motion, result, kRange, {}).at(0);
    EXPECT_EQ(found.distance, 0.0) << has_ground;
    EXPECT_EQ(found.any.width, 0.0);
  }
}

TEST_F(PairDistancesTest, WhatHasJustLeftDoesNotTouch) {
  const double touching = 0.4 - 0.25 - 1e-6;  // the box touches the block
  CycleMotion motion;
  motion.times = {0.0, 0.0325, 0.0333};  // separates at 5 m/s in the last 0.8 ms
  const auto at = [](double x) { return test::translation({x, 0, 0.5}); };
  motion.X_WB = {{at(touching), at(touching), at(touching + 0.004)},
                 std::vector<Isometry3d>(3, at(0.0)),
                 std::vector<Isometry3d>(3, test::translation({-2, 0, 1.5})),
                 std::vector<Isometry3d>(3, Isometry3d::Identity())};
  const auto& found = update(motion);
  ASSERT_EQ(result_.pairs[0].verdict, Verdict::kContact);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].distance, 0.004 - 1e-6, 1e-9);
  EXPECT_GE(found[0].error, 0.0);
  EXPECT_EQ(found[0].any.width, 0.0);
}

TEST(PairDistancesOf, WhatIsInsideIsAtNoDistance) {
  const auto scene = test::build({test::body("box", test::meshShape(test::boxMesh({0.1, 0.1, 0.1}))),
                                  test::body("peg", test::meshShape(test::boxMesh({0.02, 0.02, 0.02})))});
  Monitor monitor(scene, {});
  PairDistances distances(scene);
  const CycleMotion motion =
      test::cycle(0.1, {test::still(Isometry3d::Identity()), test::still(test::translation({0.05, 0, 0}))});
  const CycleResult& result = monitor.run(motion, {true, 1});
  ASSERT_EQ(result.pairs[0].verdict, Verdict::kContact);
  const auto& found = distances.update(motion, result, 0.2, {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].distance, 0.0);
  EXPECT_FALSE(found[0].slab);
}

TEST(PairDistancesOf, AnObjectWithAPlaneAndMoreItsPlaneIsHeldByNoBall) {
  BodyDescription ground = test::body("ground", Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), true);
  ground.geometry.push_back({Primitive(Box::fromSize({0.2, 0.2, 0.2})), test::translation({0, 0, 0.1}), "box", false});
  const BodyDescription ball = test::body("ball", Primitive(Sphere{0.1}));
  for (const bool ground_first : {false, true}) {
    const auto scene = test::build(ground_first ? std::vector<BodyDescription>{ground, ball}
                                                : std::vector<BodyDescription>{ball, ground});
    Monitor monitor(scene, {});
    PairDistances distances(scene);
    // On an arc around the origin, 100 m away, down towards the plane.
    const auto at = [](double angle) {
      return test::pose({0, 0, 0}, angle, {0, 1, 0}) * test::translation({100, 0, 0});
    };
    CycleMotion motion = test::cycle(0.1, {{at(-0.005), at(-0.003)}, test::still(Isometry3d::Identity())});
    if (ground_first) std::swap(motion.X_WB[0], motion.X_WB[1]);
    const auto& found = distances.update(motion, monitor.run(motion, {}), 2.0, {});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_GE(found[0].any.closing, 100.0 * (std::sin(0.005) - std::sin(0.003)) / 0.1 - 1e-9) << ground_first;
  }
}

/// Their coordinates are rounded by more than 1e-7 of their size then.
TEST(PairDistancesOf, TinyBodiesFarFromTheirFramesAreTrue) {
  constexpr double kSize = 5e-5, kFar = 1e6;
  const TriangleMesh mesh = test::icosphere(kSize, 1);
  const HalfSpace plane{Vector3d(0.6, 0.0, 0.8), 0.7 * kFar};
  Random random(3);
  for (const bool is_plane : {false, true}) {
    const Vector3d center = is_plane ? Vector3d(plane.offset * plane.normal) : Vector3d(kFar * test::direction(random));
    const Vector3d offset = kFar * test::direction(random);
    const TriangleMesh a = test::translated(mesh, center), b = test::translated(mesh, offset);
    const test::Shape still = is_plane ? test::Shape(Primitive(plane)) : test::meshShape(a);
    const auto scene = test::build({test::body("still", still, true), test::body("moved", test::meshShape(b))},
                                   test::fine(0.3 * kSize));
    Monitor monitor(scene, test::soft());
    PairDistances distances(scene);
    for (int i = 0; i < 40; ++i) {
      Isometry3d X_WB = test::pose(random, 3.0, 0.0);
      const Vector3d way = is_plane ? plane.normal : test::direction(random);
      X_WB.translation() = center + kSize * uniform(random, 2.1, 3.0) * way - X_WB.linear() * offset;
      monitor.reset();
      const CycleMotion motion = test::cycle(0.1, {test::still(Isometry3d::Identity()), test::still(X_WB)});
      const auto& found = distances.update(motion, monitor.run(motion, {true, 0}), 1.0, {});
      ASSERT_EQ(found.size(), 1u);
      Real truth = 1e300L;
      for (int k = 0; k < int(b.triangles.size()); ++k) {
        const test::Triangle3r t = test::exact(cornersOf(b, k), X_WB);
        for (int j = 0; j < 3 && is_plane; ++j)
          truth = std::min(truth, plane.normal.cast<Real>().dot(t[j]) - Real(plane.offset));
        for (int j = 0; j < int(a.triangles.size()) && !is_plane; ++j)
          truth = std::min(truth, test::triangleDistance(test::exact(cornersOf(a, j)), t));
      }
      EXPECT_NEAR(found[0].distance, double(truth), found[0].error);
      EXPECT_LE(found[0].any.width, truth);
    }
  }
}

TEST_F(PairDistancesTest, OfPairsThatAreDelayedTheLastOneStands) {
  const std::vector<Isometry3d> rest = {test::translation({0.4, 0, 0.5}), test::translation({0, 0, 0.5}),
                                        test::translation({-2, 0, 1.5}), Isometry3d::Identity()};
  cycle(rest, rest);
  CycleMotion motion = delayed(*scene_, rest, 0.01);
  ASSERT_EQ(update(motion).size(), 1u);
  EXPECT_NEAR(distances_.near()[0].time, 0.0, 1e-12);  // the end of the last cycle, whatever its length
  update(motion);
  EXPECT_NEAR(distances_.near()[0].time, -0.01, 1e-12);
  EXPECT_FALSE(distances_.hasUnknown());
  motion.spans.clear();
  motion.missing.assign(4, "");
  motion.missing[0] = "lost";
  EXPECT_TRUE(update(motion).empty());
}

TEST_F(PairDistancesTest, WhatIsDelayedAndWasNotMeasuredIsUnknown) {
  const std::vector<Isometry3d> rest = {test::translation({0.4, 0, 0.5}), test::translation({0, 0, 0.5}),
                                        test::translation({-2, 0, 1.5}), Isometry3d::Identity()};
  const CycleMotion waits = delayed(*scene_, rest, 0.1);
  update(waits);
  EXPECT_TRUE(distances_.hasUnknown());  // already in the first cycle
  cycle(rest, rest);
  EXPECT_FALSE(distances_.hasUnknown());
  update(waits);
  EXPECT_FALSE(distances_.hasUnknown());
  distances_.update(waits, result_, 2.0 * kRange, {});
  EXPECT_TRUE(distances_.hasUnknown());  // other pairs may be within this range
  CycleMotion lost = waits;
  lost.spans.clear();
  lost.missing = {"lost", "", "", ""};
  update(lost);
  update(waits);
  EXPECT_TRUE(distances_.hasUnknown());
  cycle(rest, rest);
  distances_.forget();
  update(waits);
  EXPECT_TRUE(distances_.hasUnknown());
  cycle(rest, rest);
  std::vector<int> now(scene_->pairs.size());
  for (std::size_t p = 0; p < now.size(); ++p) now[p] = static_cast<int>(p);
  PairDistances same(scene_), other(scene_);
  same.continueFrom(distances_, now);
  result_ = monitor_.run(waits, {true, 3});
  same.update(waits, result_, kRange, {});
  EXPECT_FALSE(same.hasUnknown());
  now.back() = -1;  // another body replaces it
  other.continueFrom(same, now);
  other.update(waits, result_, kRange, {});
  EXPECT_TRUE(other.hasUnknown());
}

TEST_F(PairDistancesTest, TwoScenesTakenOverInARowKeepIt) {
  const std::vector<Isometry3d> rest = {test::translation({0.4, 0, 0.5}), test::translation({0, 0, 0.5}),
                                        test::translation({-2, 0, 1.5}), Isometry3d::Identity()};
  ASSERT_EQ(cycle(rest, rest).size(), 1u);
  std::vector<int> same(scene_->pairs.size());
  for (std::size_t p = 0; p < same.size(); ++p) same[p] = static_cast<int>(p);
  PairDistances next(scene_), last(scene_);
  next.continueFrom(distances_, same);
  last.continueFrom(next, same);
  const CycleMotion motion = delayed(*scene_, rest, 0.1);
  result_ = monitor_.run(motion, {true, 3});
  EXPECT_EQ(last.update(motion, result_, kRange, {}).size(), 1u);
  std::fill(same.begin(), same.end(), -1);  // no pair is kept
  PairDistances other(scene_);
  other.continueFrom(last, same);
  EXPECT_TRUE(other.update(motion, result_, kRange, {}).empty());
}

}  // namespace sdf_ccd::pair_distances_test
