// Cycles that are ended by CycleRequest::max_time. Expected values: exact distances of balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd::cycle_time_test {

using namespace test;

constexpr double kRadius = 0.1;
constexpr int kBalls = 10;
constexpr double kNoTime = 1e-12;  // still, one pair is tested

/// Balls that move randomly in a room.
class CycleTime : public ::testing::Test {
 protected:
  CycleTime() {
    std::vector<BodyDescription> bodies;
    for (int i = 0; i < kBalls; ++i) {
      bodies.push_back(body("ball" + std::to_string(i), Primitive(Sphere{kRadius})));
      places_.push_back(anywhere());
    }
    scene_ = build(bodies);
  }

  Vector3d anywhere() {
    return {uniform(random_, -0.5, 0.5), uniform(random_, -0.5, 0.5), uniform(random_, -0.5, 0.5)};
  }

  /// Moves each ball a little; occasionally one starts the cycle elsewhere.
  CycleMotion next() {
    std::vector<std::vector<Isometry3d>> poses;
    for (Vector3d& place : places_) {
      if (uniform(random_, 0.0, 1.0) < 0.005) place = anywhere();
      const Vector3d from = place;
      place += 0.05 * Vector3d(uniform(random_, -1.0, 1.0), uniform(random_, -1.0, 1.0), uniform(random_, -1.0, 1.0));
      place = place.cwiseMax(-0.6).cwiseMin(0.6);
      poses.push_back({translation(from), translation(place)});
    }
    return cycle(0.1, poses);
  }

  /// Smallest distance of two balls in the cycle; if negative, its amount is their overlap.
  static double leastDistance(const CycleMotion& motion, int a, int b) {
    const Vector3d from = motion.X_WB[b][0].translation() - motion.X_WB[a][0].translation(),
                   way = motion.X_WB[b][1].translation() - motion.X_WB[a][1].translation() - from;
    const double t = way.squaredNorm() > 0.0 ? std::clamp(-from.dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
    return (from + t * way).norm() - 2.0 * kRadius;
  }

  static void expectTrue(const PairResult& pair, const CycleMotion& motion) {
    const double least = leastDistance(motion, pair.body_a, pair.body_b), bound = pair.error.total();
    ASSERT_TRUE(std::isfinite(bound));
    if (pair.verdict == Verdict::kClear) {
      EXPECT_GE(least, -bound);
    }
    if (pair.verdict == Verdict::kContact) {
      EXPECT_LE(least, bound);
    }
    if (pair.postponed) {
      EXPECT_EQ(pair.verdict, Verdict::kUncertain);
      EXPECT_FALSE(pair.reason.empty());
      EXPECT_TRUE(pair.intervals.empty());
      EXPECT_LE(-least, bound);
    }
  }

  Random random_{11};
  std::vector<Vector3d> places_;
  std::shared_ptr<const Scene> scene_;
};

TEST_F(CycleTime, WhatIsLeftIsUncertainByNoMoreThanItMayOverlap) {
  Monitor monitor(scene_, {});
  CycleRequest request;
  request.max_time = kNoTime;
  std::vector<int> waited(scene_->pairs.size(), 0);
  int postponed = 0, tight = 0, contacts = 0, longest = 0, short_of_time = 0, tested = 0;
  for (int i = 0; i < 3000; ++i) {
    const CycleMotion motion = next();
    const CycleResult& result = monitor.run(motion, request);
    int found = 0;
    for (std::size_t p = 0; p < result.pairs.size(); ++p) {
      const PairResult& pair = result.pairs[p];
      expectTrue(pair, motion);
      found += pair.postponed;
      contacts += pair.verdict == Verdict::kContact;
      tight += pair.postponed && pair.error.total() < kRadius;
      waited[p] = pair.postponed ? waited[p] + 1 : 0;
      longest = std::max(longest, waited[p]);
    }
    EXPECT_EQ(result.postponed, found);
    EXPECT_LE(result.checked, 1);
    EXPECT_EQ(result.checked + result.skipped + result.postponed, int(result.pairs.size()));
    if (found > 0) {
      ++short_of_time;
      tested += result.checked;  // except if the known clearance turns out to suffice
      EXPECT_TRUE(mayTouch(result.verdict));
    }
    postponed += found;
  }
  EXPECT_GT(postponed, 1000);
  EXPECT_GT(tested, 0.9 * short_of_time);
  EXPECT_GT(contacts, 50);
  EXPECT_GT(tight, 100);
  EXPECT_LE(longest, int(scene_->pairs.size()));  // each pair gets its turn
}

/// Balls that stay apart need no test.
TEST_F(CycleTime, WhatIsFarAwayIsClearWithoutATest) {
  CycleRequest request;
  request.max_time = kNoTime;
  int clear = 0;
  for (int i = 0; i < 200; ++i) {
    Monitor monitor(scene_, {});
    const CycleMotion motion = next();
    for (const PairResult& pair : monitor.run(motion, request).pairs) {
      expectTrue(pair, motion);
      // A ball moves at most 0.05 m along each axis.
      if (leastDistance(motion, pair.body_a, pair.body_b) < 0.18) continue;
      EXPECT_EQ(pair.verdict, Verdict::kClear);
      const Vector3d apart = motion.X_WB[pair.body_a][1].translation() - motion.X_WB[pair.body_b][1].translation();
      EXPECT_LE(pair.clearance, apart.norm() - 2.0 * kRadius);
      ++clear;
    }
  }
  EXPECT_GT(clear, 1000);
}

TEST_F(CycleTime, EnoughOfItChangesNothing) {
  Monitor with(scene_, {}), without(scene_, {});
  CycleRequest request;
  request.max_time = 1000.0;
  for (int i = 0; i < 300; ++i) {
    const CycleMotion motion = next();
    const CycleResult &a = with.run(motion, request), &b = without.run(motion, {});
    ASSERT_EQ(a.verdict, b.verdict);
    ASSERT_EQ(a.error_bound, b.error_bound);
    EXPECT_EQ(a.postponed, 0);
    for (std::size_t p = 0; p < a.pairs.size(); ++p) {
      ASSERT_EQ(a.pairs[p].verdict, b.pairs[p].verdict);
      ASSERT_EQ(a.pairs[p].clearance, b.pairs[p].clearance);
      ASSERT_EQ(a.pairs[p].on_a_W.force, b.pairs[p].on_a_W.force);
    }
  }
}

TEST_F(CycleTime, IsRecoveredFrom) {
  Monitor monitor(scene_, {});
  CycleRequest short_of_time;
  short_of_time.max_time = kNoTime;
  for (int i = 0; i < 200; ++i) {
    const CycleMotion motion = next();
    const CycleResult& result = monitor.run(motion, i % 10 == 9 ? CycleRequest() : short_of_time);
    for (const PairResult& pair : result.pairs) expectTrue(pair, motion);
    if (i % 10 != 9) continue;
    EXPECT_EQ(result.postponed, 0);
    for (const PairResult& pair : result.pairs) {
      const double least = leastDistance(motion, pair.body_a, pair.body_b);
      if (std::abs(least) > pair.error.total()) {
        EXPECT_EQ(pair.verdict, least > 0.0 ? Verdict::kClear : Verdict::kContact);
      }
    }
  }
}

/// Transforms of some bodies come in every third cycle, or are missing in the others. Their pairs wait for their turn
/// as all others do, although these are postponed more often.
TEST_F(CycleTime, WhatComesLateIsTestedSomeTime) {
  for (const bool is_missing : {false, true}) {
    Monitor monitor(scene_, {});
    CycleRequest request;
    request.max_time = kNoTime;
    const std::size_t pairs = scene_->pairs.size();
    std::vector<int> tested(pairs, 0);
    for (int i = 0; i < 12 * int(pairs); ++i) {
      std::vector<std::vector<Isometry3d>> poses;  // all of them overlap
      for (int ball = 0; ball < kBalls; ++ball)
        poses.push_back(
            {translation({1e-3 * ball, 1e-3 * (i % 2), 0}), translation({1e-3 * ball, 1e-3 - 1e-3 * (i % 2), 0})});
      CycleMotion motion = cycle(0.1, poses);
      const bool is_late = i % 3 > 0;
      motion.spans.assign(pairs, {0, 1});
      motion.missing.resize(kBalls);
      for (std::size_t p = 0; p < pairs; ++p)
        if (is_late && !is_missing && scene_->pairs[p].body_b == kBalls - 1) motion.spans[p] = {0, 0};
      if (is_late && is_missing) motion.missing[kBalls - 1] = "late";
      const CycleResult& result = monitor.run(motion, request);
      for (std::size_t p = 0; p < pairs; ++p) tested[p] += result.pairs[p].verdict == Verdict::kContact;
    }
    EXPECT_GE(*std::min_element(tested.begin(), tested.end()), 3) << is_missing;
  }
}

TEST_F(CycleTime, AnyAmountOfItIsEnoughTime) {
  for (const double time : {1e9, 1e10, 1e300, std::numeric_limits<double>::infinity()}) {
    Monitor monitor(scene_, {});
    CycleRequest request;
    request.max_time = time;
    EXPECT_EQ(monitor.run(next(), request).postponed, 0) << time;
  }
}

TEST_F(CycleTime, WhatCannotBeCheckedIsNotPostponed) {
  Monitor monitor(scene_, {});
  CycleRequest request;
  request.max_time = kNoTime;
  CycleMotion motion = next();
  motion.missing.resize(kBalls);
  motion.missing[3] = "lost";
  const CycleResult& result = monitor.run(motion, request);
  for (const PairResult& pair : result.pairs) {
    const bool is_lost = pair.body_a == 3 || pair.body_b == 3;
    EXPECT_EQ(pair.verdict == Verdict::kNotChecked, is_lost);
    EXPECT_EQ(pair.postponed && is_lost, false);
  }
  EXPECT_EQ(result.not_checked, kBalls - 1);
}

/// A bead at the centre of a ball: separating them takes the sum of both radii.
TEST(CycleTimeOfTwo, WhatIsLeftMayLieDeepInALargerBody) {
  const auto scene = build({body("ball", Primitive(Sphere{0.3})), body("bead", Primitive(Sphere{0.02})),
                            body("other", Primitive(Sphere{0.02}))});
  Monitor monitor(scene, {});
  CycleRequest request;
  request.max_time = kNoTime;
  const Isometry3d X = Isometry3d::Identity();
  int postponed = 0;
  for (const PairResult& pair : monitor.run(cycle(0.1, {still(X), still(X), still(X)}), request).pairs) {
    if (!pair.postponed) continue;
    ++postponed;
    const bool are_beads = pair.body_a > 0;
    EXPECT_GE(pair.error.total(), are_beads ? 0.04 : 0.32);
    EXPECT_LT(pair.error.total(), 0.35);
  }
  EXPECT_EQ(postponed, 2);
}

/// The motion error of a half-space holds within 10 m of its origin and grows in proportion beyond. Beads 30 m away,
/// whose pairs have never been tested.
TEST(CycleTimeOfTwo, WhatIsLeftOnAHalfSpaceKnowsHowFarThatMayStray) {
  constexpr double kAway = 30.0, kError = 1e-3;
  const auto scene =
      build({body("floor", Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), true), body("a", Primitive(Sphere{0.05})),
             body("b", Primitive(Sphere{0.05})), body("c", Primitive(Sphere{0.05}))});
  Monitor monitor(scene, {});
  CycleRequest request;
  request.max_time = kNoTime;
  CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({kAway, 0, 0})),
                                   still(translation({kAway, 1, 0})), still(translation({kAway, 2, 0}))});
  motion.motion_error = {kError, 0.0, 0.0, 0.0};
  int postponed = 0;
  for (const PairResult& pair : monitor.run(motion, request).pairs) {
    if (!pair.postponed) continue;
    ++postponed;
    // Depth of one radius, of a ball enlarged by up to the shell's spacing, plus the error of the floor's motion.
    EXPECT_GE(pair.error.chord, 0.05 + 3.0 * kError);
    EXPECT_LT(pair.error.chord, 0.06 + 4.0 * kError);
  }
  EXPECT_EQ(postponed, 2);
}

/// Two balls of many triangles that roll on each other, hardly apart, and two beads that are tested before them. The
/// search for the balls' verdict ends with the time of each cycle that has too little of it.
TEST(CycleTimeOfTwo, ALongSearchEndsInTime) {
  BodyDescription a = body("a", meshShape(icosphere(0.2, 5)));  // the ball around it says little
  a.geometry.push_back({Primitive(Sphere{0.01}), translation({-0.4, 0.0, 0.0}), "bead"});
  const auto scene = build({body("bead", Primitive(Sphere{0.01})), body("other", Primitive(Sphere{0.01})), a,
                            body("b", meshShape(icosphere(0.2, 5)))},
                           fine(0.008));
  constexpr std::size_t kWaypoints = 40;
  std::vector<Isometry3d> rolling;
  for (std::size_t k = 0; k < kWaypoints; ++k) {
    Isometry3d X = translation({0.4001, 0.0, 0.0});
    X.rotate(Eigen::AngleAxisd(0.5 * double(k), Vector3d(1, 2, 3).normalized()));
    rolling.push_back(X);
  }
  const CycleMotion motion =
      cycle(1.0, {still(translation({0.0, 1.0, 0.0}), kWaypoints), still(translation({0.0, 1.01, 0.0}), kWaypoints),
                  still(Isometry3d::Identity(), kWaypoints), rolling});
  const auto balls = [](const CycleResult& result) { return result.pairs.back(); };
  CycleRequest request = {};
  request.wrenches = request.contacts = false;
  double whole = 1e9, cut = 1e9;
  for (int i = 0; i < 3; ++i) {
    Monitor monitor(scene, {});
    const CycleResult& result = monitor.run(motion, request);
    whole = std::min(whole, result.run_time);
    EXPECT_EQ(balls(result).verdict, Verdict::kClear);
  }
  for (int i = 0; i < 3; ++i) {
    CycleRequest limited = request;
    limited.max_time = 0.1 * whole;
    Monitor monitor(scene, {});
    const CycleResult& result = monitor.run(motion, limited);
    cut = std::min(cut, result.run_time);
    EXPECT_TRUE(balls(result).postponed);
    EXPECT_EQ(balls(result).verdict, Verdict::kUncertain);
    EXPECT_GT(balls(result).error.total(), 0.4 - 0.4001);
    EXPECT_EQ(balls(monitor.run(motion, limited)).verdict, Verdict::kUncertain);  // also if it comes first
    EXPECT_EQ(balls(monitor.run(motion, request)).verdict, Verdict::kClear);
  }
  EXPECT_LT(cut, 0.5 * whole);
}

/// A bead moves into a box while the pair is postponed; afterwards no surfaces cross.
TEST(CycleTimeOfTwo, WhatGotInsideMeanwhileIsFound) {
  const auto scene = build({body("box", Primitive(Box::fromSize({0.6, 0.6, 0.6})), true),
                            body("bead", Primitive(Sphere{0.02})), body("post", Primitive(Sphere{0.3}))});
  Monitor monitor(scene, {});
  CycleRequest request;
  request.max_time = kNoTime;
  // The post is inside the box all the time, so that another pair is always due.
  const auto motionOf = [&](double from, double to) {
    return cycle(0.1, {still(Isometry3d::Identity()),
                       {translation({from, 0, 0}), translation({to, 0, 0})},
                       still(translation({0, 0.25, 0.0}))});
  };
  const auto verdictOf = [&](const CycleResult& result) {
    for (const PairResult& pair : result.pairs)
      if (scene->bodies[pair.body_a].name == "box" && scene->bodies[pair.body_b].name == "bead") return pair.verdict;
    return Verdict::kNotChecked;
  };
  for (int i = 0; i < 4; ++i) EXPECT_NE(verdictOf(monitor.run(motionOf(1.0, 1.0), request)), Verdict::kContact);
  EXPECT_NE(verdictOf(monitor.run(motionOf(1.0, 0.0), request)), Verdict::kClear);
  for (int i = 0; i < 5; ++i) EXPECT_NE(verdictOf(monitor.run(motionOf(0.0, 0.0), request)), Verdict::kClear);
  EXPECT_EQ(verdictOf(monitor.run(motionOf(0.0, 0.0), {})), Verdict::kContact);
}

}  // namespace sdf_ccd::cycle_time_test
