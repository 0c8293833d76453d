#include "sdf_ccd/monitor.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <array>
#include <limits>
#include <stdexcept>
#include <tuple>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "shell/point_shell.h"

namespace sdf_ccd::monitor_test {

using namespace test;

TEST(Monitor, GivesAllFourVerdicts) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.02));
  Monitor monitor(scene, soft());
  const auto verdictAt = [&](double height) {
    monitor.reset();
    return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, height}))}), {});
  };
  EXPECT_EQ(verdictAt(0.1001).verdict, Verdict::kClear);
  EXPECT_EQ(verdictAt(0.1).verdict, Verdict::kUncertain);
  EXPECT_EQ(verdictAt(0.0999).verdict, Verdict::kContact);
  CycleMotion lost = cycle(0.1, {still(Isometry3d::Identity()), {}});
  lost.missing = {"", "no transform from ball to world"};
  const CycleResult& result = monitor.run(lost, {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.pairs[0].reason, lost.missing[1]);
  EXPECT_EQ(result.not_checked, 1);
}

TEST(Monitor, FindsContactBetweenTheSamples) {
  const auto scene =
      build({body("plate", Primitive(Box::fromSize({0.1, 0.1, 0.001})), true), body("ball", Primitive(Sphere{0.02}))},
            fine(0.004));
  Monitor monitor(scene, soft());
  // Through the plate from above to below within one cycle.
  const CycleResult& result = monitor.run(
      cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, 0.1}), translation({0, 0, -0.1})}}), {true, 5});
  const PairResult& pair = result.pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_FALSE(touchesAtEnds(pair, 0.1));
  ASSERT_EQ(pair.intervals.size(), 1u);
  EXPECT_NEAR(pair.intervals[0].enter, 0.1 * (0.1 - 0.0205) / 0.2, 1e-3);
  EXPECT_NEAR(pair.intervals[0].exit, 0.1 * (0.1 + 0.0205) / 0.2, 1e-3);
  EXPECT_EQ(pair.points.size(), 5u);
  EXPECT_LE(pair.points[0].depth, pair.deepest.depth);
  EXPECT_NEAR(pair.deepest.depth, 0.02, pair.deepest.depth_error);  // of the plate's points inside the ball
}

TEST(Monitor, SeesWhatASampleSees) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const auto fall = [&](double from, double to) {
    const CycleMotion motion =
        cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, from}), translation({0, 0, to})}});
    return touchesAtEnds(monitor.run(motion, {}).pairs[0], 0.1);
  };
  EXPECT_TRUE(fall(0.3, 0.09));
  EXPECT_TRUE(fall(0.09, 0.3));
  EXPECT_FALSE(fall(0.3, 0.2));
}

TEST(Monitor, QuarterTurnWithinOneCycle) {
  // A bar swings through a post that it touches neither before nor after.
  BodyDescription bar = body("bar", Primitive(Box::fromSize({0.5, 0.04, 0.04})));
  bar.geometry[0].X_BG = translation({0.35, 0, 0});
  const auto scene = build({body("post", Primitive(Cylinder::fromRadiusAndLength(0.03, 0.4)), true), bar});
  Monitor monitor(scene, soft());
  const Isometry3d post = translation({0.3, 0.3, 0});
  const CycleMotion swing = cycle(0.1, {still(post), {Isometry3d::Identity(), pose({0, 0, 0}, kPi / 2, {0, 0, 1})}});
  const PairResult& pair = monitor.run(swing, {}).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_FALSE(touchesAtEnds(pair, 0.1));
  EXPECT_LT(pair.error.chord, 2e-4);
  // The chord of the bar's tip runs inside the arc: a straight path would give other times.
  const double half_angle = std::asin((0.03 + 0.02) / (0.3 * std::sqrt(2.0)));
  ASSERT_EQ(pair.intervals.size(), 1u);
  EXPECT_NEAR(pair.intervals[0].enter, 0.1 * (0.5 - half_angle / (kPi / 2)), 1e-3);
  EXPECT_NEAR(pair.intervals[0].exit, 0.1 * (0.5 + half_angle / (kPi / 2)), 1e-3);
}

TEST(Monitor, ResultsDoNotDependOnThreads) {
  Random random(9);
  std::vector<BodyDescription> bodies;
  for (int i = 0; i < 6; ++i)
    bodies.push_back(body("b" + std::to_string(i), Primitive(Box::fromSize({0.2, 0.16, 0.1}))));
  const auto scene = build(bodies, fine(0.02));
  Monitor one(scene, soft()), two(scene, soft());
  for (int i = 0; i < 10; ++i) {
    std::vector<std::vector<Isometry3d>> poses;
    for (int b = 0; b < 6; ++b) {
      const Isometry3d X = pose(random, 3.0, 0.25);
      poses.push_back({X, X * pose({0.05, 0, 0}, 0.3, {1, 1, 0})});
    }
    const CycleMotion motion = cycle(0.1, poses);
    const auto runWith = [&](Monitor& monitor, std::size_t threads) -> const CycleResult& {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return monitor.run(motion, {true, 3});
    };
    const CycleResult &a = runWith(one, 1), &b = runWith(two, 2);
    for (std::size_t p = 0; p < a.pairs.size(); ++p) {
      ASSERT_EQ(a.pairs[p].verdict, b.pairs[p].verdict);
      ASSERT_EQ(a.pairs[p].on_a_W.force, b.pairs[p].on_a_W.force);
      ASSERT_EQ(a.pairs[p].on_b_W.torque, b.pairs[p].on_b_W.torque);
      ASSERT_EQ(a.pairs[p].deepest.p_W, b.pairs[p].deepest.p_W);
      ASSERT_EQ(a.pairs[p].points.size(), b.pairs[p].points.size());
    }
  }
}

bool same(const ContactPoint& a, const ContactPoint& b) {
  return a.enter == b.enter && a.exit == b.exit && a.time == b.time && a.depth == b.depth &&
         a.depth_error == b.depth_error && a.p_W == b.p_W && a.normal_W == b.normal_W;
}

bool same(const Wrench& a, const Wrench& b) {
  return a.force == b.force && a.torque == b.torque;
}

bool same(const ErrorSources& a, const ErrorSources& b) {
  return a.field == b.field && a.chord == b.chord && a.root == b.root && a.gap == b.gap;
}

/// Bitwise equality.
void expectSame(const CycleResult& a, const CycleResult& b) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.error_bound, b.error_bound);
  EXPECT_TRUE(same(a.error, b.error));
  EXPECT_EQ(std::tie(a.checked, a.skipped, a.not_checked, a.delayed),
            std::tie(b.checked, b.skipped, b.not_checked, b.delayed));
  for (std::size_t i = 0; i < a.pairs.size(); ++i) {
    const PairResult &p = a.pairs[i], &q = b.pairs[i];
    EXPECT_EQ(p.verdict, q.verdict);
    EXPECT_EQ(p.reason, q.reason);
    EXPECT_EQ(p.skipped, q.skipped);
    EXPECT_EQ(p.clearance, q.clearance);
    EXPECT_TRUE(same(p.error, q.error));
    EXPECT_TRUE(same(p.deepest, q.deepest));
    EXPECT_TRUE(same(p.on_a_W, q.on_a_W) && same(p.on_b_W, q.on_b_W));
    ASSERT_EQ(p.intervals.size(), q.intervals.size());
    for (std::size_t k = 0; k < p.intervals.size(); ++k)
      EXPECT_TRUE(p.intervals[k].enter == q.intervals[k].enter && p.intervals[k].exit == q.intervals[k].exit);
    ASSERT_EQ(p.points.size(), q.points.size());
    for (std::size_t k = 0; k < p.points.size(); ++k) EXPECT_TRUE(same(p.points[k], q.points[k]));
  }
}

/// Includes the state that is kept between cycles (clearances, witnesses, memory), for bodies of all kinds.
TEST(Monitor, CyclesDoNotDependOnThreads) {
  std::vector<BodyDescription> bodies = {body("ground", ground(), true)};
  for (int i = 0; i < 3; ++i) {
    const std::string number = std::to_string(i);
    bodies.push_back(body("box" + number, meshShape(boxMesh({0.1, 0.08, 0.05}))));
    bodies.push_back(body("ball" + number, Primitive(Sphere{0.07})));
    bodies.push_back(body("drum" + number, Primitive(Cylinder::fromRadiusAndLength(0.06, 0.16))));
    bodies.push_back(body("ring" + number, meshShape(torusMesh(0.1, 0.03, 24, 12))));
  }
  const auto scene = build(bodies, fine(0.02));
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);  // also on a smaller machine
  for (const CycleRequest& request : {CycleRequest{true, 3, true, true}, CycleRequest{false, 0, false, false}}) {
    std::array<Monitor, 3> monitors = {Monitor(scene, soft()), Monitor(scene, soft()), Monitor(scene, soft())};
    Random random(11);
    std::vector<Isometry3d> X_WB(bodies.size(), Isometry3d::Identity()), step = X_WB;
    int contacts = 0;
    for (int i = 0; i < 60; ++i) {
      std::vector<std::vector<Isometry3d>> poses;
      for (std::size_t b = 0; b < bodies.size(); ++b) {
        if (b > 0 && i % 20 == 0) X_WB[b] = pose(random, 3.0, 0.35);
        if (b > 0 && i % 20 == 0) step[b] = pose(pose(random, 3.0, 0.01).translation(), 0.05, {1, 1, 0});
        poses.push_back({X_WB[b], X_WB[b] * step[b]});
        X_WB[b] = poses.back().back();
      }
      const CycleMotion motion = cycle(0.01, poses);
      std::array<const CycleResult*, 3> results;
      for (std::size_t k = 0; k < monitors.size(); ++k) {
        const int threads = k == 0 ? 1 : static_cast<int>(2 * k);
        tbb::task_arena(threads).execute([&] { results[k] = &monitors[k].run(motion, request); });
      }
      for (const CycleResult* result : results) expectSame(*results[0], *result);
      for (const PairResult& pair : results[0]->pairs) contacts += pair.verdict == Verdict::kContact;
    }
    EXPECT_GT(contacts, 300);
  }
}

TEST(Monitor, WithoutSubscribersNoWrenchAndNoPoints) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, 0.09}))});
  const PairResult pair = monitor.run(motion, {false, 0}).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_EQ(pair.on_a_W.force, Vector3d::Zero());
  EXPECT_TRUE(pair.points.empty());
  EXPECT_NEAR(pair.deepest.depth, 0.01, 1e-3);
}

/// Deep inside, a field's depth is much less accurate than near the surface: the bead may be in the cavity.
TEST(Monitor, MotionErrorBeyondTheBandNeverMakesContact) {
  BodyOptions options = fine(0.004);
  options.field.cells = 64;
  const TriangleMesh cavity = flipped(boxMesh({0.006, 0.006, 0.006}));
  const auto scene = build({body("block", meshShape(merged(boxMesh({0.5, 0.5, 0.5}), cavity)), true),
                            body("bead", Primitive(Sphere{0.005}))},
                           options);
  Monitor monitor(scene, soft());
  Random random(3);
  int deep = 0;
  for (int i = 0; i < 200; ++i) {
    const Vector3d p = pose(random, 3.0, 0.25).translation();
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation(p))});
    motion.motion_error = {0.0, p.norm()};
    monitor.reset();
    const PairResult& result = monitor.run(motion, {}).pairs[0];
    EXPECT_NE(result.verdict, Verdict::kContact) << p.transpose() << ": " << result.deepest.depth << " m deep";
    deep += result.deepest.depth > 0.05;
  }
  EXPECT_GT(deep, 50);
}

TEST(Monitor, BoundBeyondTheBandNeverMakesClear) {
  // Only a sampled field with a narrow band, and a motion error of 20 cm.
  BodyDescription map = body("map", meshShape(boxMesh({0.1, 0.1, 0.1})), true);
  map.geometry[0].watertight_voxels = true;
  const auto scene = build({map, body("ball", Primitive(Sphere{0.05}))});
  Monitor monitor(scene, soft());
  const auto verdictAt = [&](double distance) {
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({0.15 + distance, 0, 0}))});
    motion.motion_error = {0.1, 0.1};
    monitor.reset();
    return monitor.run(motion, {}).verdict;
  };
  ASSERT_LT(scene->bodies[0].parts[0].field.band(), 0.05);
  EXPECT_EQ(verdictAt(0.1), Verdict::kUncertain);
  EXPECT_EQ(verdictAt(0.19), Verdict::kUncertain);
  EXPECT_EQ(verdictAt(0.3), Verdict::kClear);
}

TEST(Monitor, MotionErrorsOfBothBodiesCount) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const auto run = [&](double height, double angle) -> const PairResult& {
    const Isometry3d X = translation({0, 0, height});
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), {X, X * pose({0, 0, 0}, angle, {1, 0, 0})}});
    motion.motion_error = {0.01, 0.02};
    monitor.reset();
    return monitor.run(motion, {}).pairs[0];
  };
  EXPECT_EQ(run(0.075, 0.0).verdict, Verdict::kUncertain);  // 25 mm deep, known to 30 mm
  EXPECT_EQ(run(0.065, 0.0).verdict, Verdict::kContact);
  EXPECT_EQ(run(0.1299, 0.0).verdict, Verdict::kUncertain);
  EXPECT_EQ(run(0.1302, 0.0).verdict, Verdict::kClear);
  EXPECT_NEAR(run(0.1, 1.0).error.chord, 0.03, 1e-9);
}

TEST(Monitor, PairsAreCheckedOverTheirOwnSpans) {
  const auto scene = build(
      {body("ground", ground(), true), body("ball", Primitive(Sphere{0.1})), body("other", Primitive(Sphere{0.1}))});
  ASSERT_EQ(scene->pairs.size(), 3u);  // ground - ball, ground - other, ball - other
  // The ball dips into the ground and comes out again, then the other one does.
  const auto dip = [&](int deepest) {
    std::vector<Isometry3d> X;
    for (int k = 0; k < 5; ++k) X.push_back(translation({double(deepest), 0, k == deepest ? 0.09 : 0.3}));
    return X;
  };
  CycleMotion motion = cycle(0.4, {still(Isometry3d::Identity(), 5), dip(1), dip(3)});
  Monitor monitor(scene, soft()), whole(scene, soft());
  const CycleResult& all = whole.run(motion, {true, 3});
  EXPECT_EQ(all.pairs[0].verdict, Verdict::kContact);
  EXPECT_EQ(all.pairs[1].verdict, Verdict::kContact);

  motion.spans = {{0, 2}, {0, 0}, {0, 0}};
  const CycleResult& first = monitor.run(motion, {true, 3});
  EXPECT_EQ(first.verdict, Verdict::kContact);
  EXPECT_EQ(first.delayed, 2);
  EXPECT_EQ(first.checked + first.skipped, 1);
  EXPECT_EQ(first.not_checked, 0);
  EXPECT_NEAR(first.pairs[0].intervals[0].enter, all.pairs[0].intervals[0].enter, 1e-12);
  EXPECT_LT((2.0 * all.pairs[0].on_a_W.force - first.pairs[0].on_a_W.force).norm(), 1e-9);  // over half of the time
  EXPECT_LT((2.0 * all.pairs[0].on_b_W.force - first.pairs[0].on_b_W.force).norm(), 1e-9);

  motion.spans = {{2, 4}, {0, 2}, {2, 2}};
  const CycleResult& second = monitor.run(motion, {});
  EXPECT_EQ(second.verdict, Verdict::kNotChecked);  // the checked pairs are CLEAR, but one pair is delayed
  EXPECT_EQ(second.pairs[0].verdict, Verdict::kClear);
  EXPECT_EQ(second.pairs[1].verdict, Verdict::kClear);
  motion.spans = {{4, 4}, {2, 4}, {0, 4}};
  const CycleResult& last = monitor.run(motion, {true, 3});
  EXPECT_EQ(last.pairs[1].verdict, Verdict::kContact);
  EXPECT_NEAR(last.pairs[1].intervals[0].exit, all.pairs[1].intervals[0].exit, 1e-12);
  EXPECT_LT((2.0 * all.pairs[1].on_b_W.force - last.pairs[1].on_b_W.force).norm(), 1e-9);
  EXPECT_LT((all.pairs[1].deepest.p_W - last.pairs[1].deepest.p_W).norm(), 1e-9);
}

TEST(Monitor, PointsOnEdgesTellCrossedPlatesApart) {
  // Two thin plates on edge, crosswise, one above the other: their rims are nearest to each other.
  BodyOptions options = fine(0.02);
  options.shell.edge_gap = 0.001;
  const Primitive plate = Box::fromSize({0.2, 0.002, 0.1});
  const auto scene = build({body("a", plate), body("b", plate)}, options),
             plain = build({body("a", plate), body("b", plate)}, fine(0.02));
  const auto verdictAt = [](const std::shared_ptr<const Scene>& scene, double apart) {
    Monitor monitor(scene, soft());
    return monitor
        .run(cycle(0.1, {still(Isometry3d::Identity()), still(pose({0.0, 0.0, 0.1 + apart}, kPi / 2, {0, 0, 1}))}), {})
        .pairs[0];
  };
  EXPECT_NEAR(scene->contact_bound.gap, 0.001 + scene->bodies[0].shell->position_error, 1e-12);
  EXPECT_EQ(verdictAt(scene, 0.0012).verdict, Verdict::kClear);
  EXPECT_NE(verdictAt(scene, 0.0).verdict, Verdict::kClear);
  EXPECT_EQ(verdictAt(scene, -0.002).verdict, Verdict::kContact);
  EXPECT_EQ(verdictAt(plain, 0.0012).verdict, Verdict::kClear) << "triangles need no points";
  EXPECT_LE(verdictAt(scene, 0.003).clearance, 0.003);
  EXPECT_GT(verdictAt(scene, 0.003).clearance, 0.001);
}

TEST(Monitor, NothingIsClearBeyondWhatNumbersHold) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.05));
  Monitor monitor(scene, soft());
  const auto run = [&](double from, double to, double motion_error) {
    CycleMotion motion =
        cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, from}), translation({0, 0, to})}});
    motion.motion_error = {0.0, motion_error};
    return monitor.run(motion, {});
  };
  EXPECT_EQ(run(9e7, 9e7, 0.0).verdict, Verdict::kClear);
  for (const double far : {2e8, 1e150, 1e300, std::numeric_limits<double>::infinity()}) {
    const CycleResult result = run(1.0, far, 0.0);
    EXPECT_EQ(result.verdict, Verdict::kNotChecked);
    EXPECT_EQ(result.error_bound, 0.0);
    EXPECT_EQ(result.pairs[0].reason.find("ball is "), 0u) << result.pairs[0].reason;
    EXPECT_EQ(run(far, far, 0.0).verdict, Verdict::kNotChecked);
  }
  const CycleResult result = run(1.0, 1.0, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.pairs[0].reason, "its error bound is not finite");
  EXPECT_EQ(run(1.0, 1.0, 0.0).verdict, Verdict::kClear);
}

TEST(Monitor, WhereNothingIsCheckedNothingIsClear) {
  Monitor monitor(build({body("ball", Primitive(Sphere{0.1}))}), soft());
  const CycleResult& result = monitor.run(cycle(0.1, {still(Isometry3d::Identity())}), {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.checked + result.skipped + result.not_checked, 0);
}

TEST(Monitor, RefusesMotionsThatDoNotFit) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.05));
  Monitor monitor(scene, {});
  const auto still2 = still(Isometry3d::Identity());
  EXPECT_THROW(monitor.run(cycle(0.1, {still2}), {}), std::invalid_argument);
  EXPECT_THROW(monitor.run(cycle(0.1, {still2, {}}), {}), std::invalid_argument);
  EXPECT_THROW(monitor.run(cycle(-0.1, {still2, still2}), {}), std::invalid_argument);
  CycleMotion odd = cycle(0.1, {still2, still2});
  for (const std::vector<WaypointSpan>& spans : {std::vector<WaypointSpan>{{1, 0}}, std::vector<WaypointSpan>{{0, 2}},
                                                 std::vector<WaypointSpan>{{0, 1}, {0, 1}}}) {
    odd.spans = spans;
    EXPECT_THROW(monitor.run(odd, {}), std::invalid_argument);
  }
  CycleMotion bad = cycle(0.1, {still2, still2});
  bad.X_WB[1][1].translation().x() = std::nan("");
  const CycleResult& result = monitor.run(bad, {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_FALSE(result.pairs[0].reason.empty());
  EXPECT_THROW(Monitor(nullptr, {}), std::invalid_argument);
  MonitorOptions options;
  options.chords.tolerance = 0.0;
  EXPECT_THROW(Monitor(scene, options), std::invalid_argument);
}

}  // namespace sdf_ccd::monitor_test
