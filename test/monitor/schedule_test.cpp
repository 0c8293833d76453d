#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "oracle/random.h"
#include "oracle/scene_case.h"

namespace sdf_ccd::schedule_test {

using namespace test;

constexpr double kRadius = 0.08;
constexpr int kBalls = 5;

/// Randomly moving balls, and ways in which their transforms arrive: complete, late, in part, from elsewhere, missing,
/// with motion errors.
class Arrivals {
 public:
  /// @param resting  so many of the balls, the last ones, rest most of the time.
  explicit Arrivals(unsigned seed, std::size_t pairs, int resting = 0)
      : random_(seed), pairs_(pairs), resting_(static_cast<std::size_t>(resting)) {
    for (int i = 0; i < kBalls; ++i) X_.push_back(pose(random_, 3.0, 0.5));
  }

  CycleMotion next() {
    const std::size_t waypoints = 2 + random_() % 3;
    std::vector<std::vector<Isometry3d>> poses;
    for (Isometry3d& X : X_) {
      const bool rests = poses.size() >= X_.size() - resting_ && !oneIn(20);
      const double speed = rests ? 0.0 : oneIn(6) ? 0.1 : oneIn(3) ? 0.0 : 0.01;
      std::vector<Isometry3d> X_WB = {X};
      for (std::size_t k = 1; k < waypoints; ++k) {
        const Vector3d shift = speed * (direction() - 0.2 * X.translation());
        if (speed > 0.0) X = translation(shift) * X * pose(Vector3d::Zero(), speed * 5.0 * u(), direction());
        X_WB.push_back(X);
      }
      poses.push_back(X_WB);
    }
    CycleMotion motion = cycle(0.1, poses);
    if (oneIn(4)) {
      motion.spans.assign(pairs_, {0, waypoints - 1});
      for (WaypointSpan& span : motion.spans) {
        if (oneIn(4)) span.last = random_() % waypoints;
        if (oneIn(8)) span.first = random_() % (span.last + 1);
      }
    }
    if (oneIn(8)) motion.missing.assign(kBalls, "");
    if (!motion.missing.empty()) motion.missing[random_() % kBalls] = "lost";
    if (oneIn(3)) {
      for (int i = 0; i < kBalls; ++i) motion.motion_error.push_back(oneIn(10) ? 0.05 : oneIn(2) ? 0.0 : 1e-3);
      if (oneIn(10)) motion.motion_error[random_() % kBalls] = std::numeric_limits<double>::infinity();
    }
    if (oneIn(10)) X_[random_() % kBalls].translation() += 0.1 * direction();  // the next motion begins elsewhere
    return motion;
  }

 private:
  bool oneIn(unsigned n) { return random_() % n == 0; }
  double u() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  Vector3d direction() { return {u(), u(), u()}; }

  Random random_;
  std::size_t pairs_, resting_;
  std::vector<Isometry3d> X_;
};

/// Compares with testing every pair, a slow and simple reference: results are equal, except that skipped pairs are
/// clear. Also compares with the exact distance of spheres.
TEST(Schedule, SaysWhatTestingEveryPairSays) {
  std::vector<BodyDescription> bodies;
  for (int i = 0; i < kBalls; ++i) bodies.push_back(body("ball " + std::to_string(i), Primitive(Sphere{kRadius})));
  const auto buildTwice = [&] { return std::pair(build(bodies, fine(0.02)), build(bodies, fine(0.02))); };
  const auto robots = buildTwice();
  constexpr int kOfWorld = 3;
  for (int i = kBalls - kOfWorld; i < kBalls; ++i) bodies[std::size_t(i)].is_world = true;
  const auto robots_in_world = buildTwice();
  int skipped = 0, near = 0, clear = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const auto& [scene, own_scene] = seed < 6 ? robots : robots_in_world;
    Monitor skipping(scene, {}), sparing(scene, {}), testing(own_scene, {});  // which shares no answers
    Arrivals arrivals(seed, scene->pairs.size(), seed < 6 ? 0 : kOfWorld);
    for (int i = 0; i < 300; ++i) {
      const CycleMotion motion = arrivals.next();
      testing.reset();
      const CycleResult &a = skipping.run(motion, {true, 2}), &b = testing.run(motion, {true, 2});
      const CycleResult& c = sparing.run(motion, {true, 2, false});
      ASSERT_EQ(b.skipped, 0);
      ASSERT_EQ(a.checked + a.skipped, b.checked);
      ASSERT_EQ(a.not_checked, b.not_checked);
      ASSERT_EQ(a.delayed, b.delayed);
      ASSERT_EQ(a.verdict, b.verdict);
      ASSERT_EQ(c.verdict, b.verdict);
      ASSERT_EQ(c.skipped, a.skipped);
      ASSERT_NEAR(c.error_bound, a.error_bound, 1e-6);
      skipped += a.skipped;
      double worst = 0.0;
      for (std::size_t p = 0; p < a.pairs.size(); ++p) {
        const PairResult &pair = a.pairs[p], &tested = b.pairs[p], &spared = c.pairs[p];
        SCOPED_TRACE("seed " + std::to_string(seed) + ", cycle " + std::to_string(i) + ", pair " + std::to_string(p));
        ASSERT_EQ(pair.verdict, tested.verdict);
        ASSERT_EQ(pair.reason, tested.reason);
        ASSERT_EQ(pair.span.first, tested.span.first);
        ASSERT_EQ(pair.span.last, tested.span.last);
        ASSERT_EQ(pair.intervals.size(), tested.intervals.size());
        ASSERT_EQ(pair.points.size(), tested.points.size());
        ASSERT_NEAR(pair.deepest.depth, tested.deepest.depth, pair.deepest.depth_error + tested.deepest.depth_error);
        ASSERT_EQ(pair.on_a_W.force, tested.on_a_W.force);
        ASSERT_EQ(spared.verdict, tested.verdict);
        ASSERT_EQ(spared.skipped, pair.skipped);
        ASSERT_EQ(spared.span.last, tested.span.last);
        ASSERT_EQ(spared.intervals.size(), tested.intervals.size());
        if (pair.verdict != Verdict::kNotChecked) worst = std::max(worst, pair.error.total());
        near += mayTouch(pair.verdict);
        if (pair.verdict != Verdict::kClear) continue;
        ++clear;
        const auto distance = [&](std::size_t k, double s) {
          const auto placeOf = [&](int body) {
            const auto& X_WB = motion.X_WB[std::size_t(body)];
            return s == 0.0 ? Vector3d(X_WB[k].translation())
                            : Vector3d(ScrewMotion(X_WB[k], X_WB[k + 1]).pose(s).translation());
          };
          return (placeOf(pair.body_a) - placeOf(pair.body_b)).norm() - 2.0 * kRadius;
        };
        double motion_error = 0.0;
        for (const int body : {pair.body_a, pair.body_b})
          motion_error += motion.motion_error.empty() ? 0.0 : motion.motion_error[std::size_t(body)];
        for (std::size_t k = pair.span.first; k < pair.span.last; ++k)
          for (int step = 0; step <= 4; ++step) ASSERT_GT(distance(k, 0.25 * step), motion_error);
        ASSERT_LE(pair.clearance, distance(pair.span.last, 0.0) - motion_error + 1e-12);
        ASSERT_LE(spared.clearance, distance(pair.span.last, 0.0) - motion_error + 1e-12);
        ASSERT_GE(pair.error.chord, motion_error);
      }
      // The largest bound is accurate to single precision.
      if (std::isfinite(worst)) {
        ASSERT_NEAR(a.error_bound, worst, 1e-6);
      }
    }
  }
  EXPECT_GT(skipped, 3000);
  EXPECT_GT(near, 300);
  EXPECT_GT(clear, 8000);
}

/// Obstacles at equal distances from a moving ball would all be due in the same cycles, again and again, if none were
/// measured before that.
TEST(Schedule, MeasuresPairsBeforeManyAreDueAtOnce) {
  std::vector<BodyDescription> bodies = {body("ball", Primitive(Sphere{0.05}))};
  constexpr int kObstacles = 6;
  for (int i = 0; i < kObstacles; ++i)
    bodies.push_back(body("obstacle " + std::to_string(i), Primitive(Box::fromSize({0.1, 0.08, 0.06}))));
  std::vector<std::vector<Isometry3d>> X_WB(1 + kObstacles);
  for (int i = 0; i < kObstacles; ++i) {
    const double angle = 2.0 * M_PI * i / kObstacles;
    X_WB[1 + i] = {pose(0.2 * Vector3d(std::cos(angle), std::sin(angle), 0.0), angle, Vector3d::UnitZ())};
  }
  MonitorOptions options;
  const auto scene = build(bodies, fine(0.02));
  Monitor monitor(scene, options);
  std::size_t most = 0, due = 0;
  for (int k = 0; k < 400; ++k) {  // up and down along the axis
    const auto at = [](int step) { return translation({0.0, 0.0, 0.15 * std::sin(0.02 * step)}); };
    X_WB[0] = {at(k), at(k + 1)};
    const CycleResult& result = monitor.run(cycle(0.001, X_WB), {});
    ASSERT_EQ(result.verdict, Verdict::kClear);
    if (k == 0) continue;
    const auto now = static_cast<std::size_t>(result.checked);
    most = std::max(most, now);
    due += now;
  }
  EXPECT_LE(most, 4U);
  EXPECT_GT(due, 0U);
}

TEST(Schedule, KeepsWhatItKnowsUntilItIsReset) {
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, fine(0.02));
  Monitor monitor(scene, {});
  const auto at = [](double x) {
    return cycle(0.1, {still(Isometry3d::Identity()), still(translation({x, 0.0, 0.0}))});
  };
  EXPECT_FALSE(monitor.run(at(1.0), {}).pairs[0].skipped);
  EXPECT_TRUE(monitor.run(at(1.0), {}).pairs[0].skipped);
  CycleMotion bad = at(1.0);
  bad.times = {0.0, -1.0};
  EXPECT_THROW(monitor.run(bad, {}), std::invalid_argument);  // rejected before any state changes
  EXPECT_TRUE(monitor.run(at(1.0), {}).pairs[0].skipped);
  EXPECT_EQ(monitor.run(at(0.15), {}).pairs[0].verdict, Verdict::kContact);
  EXPECT_EQ(monitor.run(at(1.0), {}).pairs[0].verdict, Verdict::kClear);
  EXPECT_TRUE(monitor.run(at(1.0), {}).pairs[0].skipped);
  EXPECT_TRUE(monitor.run(at(1.0), {}).pairs[0].intervals.empty());
  monitor.reset();
  EXPECT_FALSE(monitor.run(at(1.0), {}).pairs[0].skipped);
}

}  // namespace sdf_ccd::schedule_test
