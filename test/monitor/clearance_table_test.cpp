#include "monitor/clearance_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "monitor/clearance_table_case.h"
#include "oracle/long_screw.h"
#include "oracle/shapes.h"

namespace sdf_ccd::clearance_table_test {

using namespace test;

/// Largest change of the distance of two points, one in each ball, over a motion; found by random climbing.
Real largestChange(const Scene& scene, const PlannedPair& pair, const CycleMotion& motion, Random& random) {
  const auto ballOf = [&](int body) -> const BoundingBall& { return scene.bodies[std::size_t(body)].ball; };
  const std::size_t steps = motion.times.size() - 1;
  std::vector<LongScrew> a, b;
  for (std::size_t k = 0; k < steps; ++k) {
    const auto screw = [&](int body) {
      return LongScrew(motion.X_WB[std::size_t(body)][k], motion.X_WB[std::size_t(body)][k + 1]);
    };
    a.push_back(screw(pair.body_a));
    b.push_back(screw(pair.body_b));
  }
  const auto distance = [&](const Vector3d& p_A, const Vector3d& p_B, Real time) {
    const auto k = std::min(steps - 1, static_cast<std::size_t>(time));
    return (a[k].pose(time - Real(k)) * p_A.cast<Real>() - b[k].pose(time - Real(k)) * p_B.cast<Real>()).norm();
  };
  Vector3d best_a = direction(random), best_b = direction(random);
  double best_time = double(steps);
  Real most = 0;
  for (int tries = 0; tries < 40; ++tries) {
    const double size = tries < 10 ? 1.0 : 0.2;
    const Vector3d u = (best_a + size * direction(random)).normalized();
    const Vector3d v = (best_b + size * direction(random)).normalized();
    const double time = std::clamp(best_time + size * uniform(random, -1.0, 0.3), 0.0, double(steps));
    const BoundingBall &ball_a = ballOf(pair.body_a), &ball_b = ballOf(pair.body_b);
    const Vector3d p_A = ball_a.center + ball_a.radius * u, p_B = ball_b.center + ball_b.radius * v;
    const Real change = std::abs(distance(p_A, p_B, time) - distance(p_A, p_B, 0));
    if (change <= most) continue;
    most = change;
    best_a = u;
    best_b = v;
    best_time = time;
  }
  return most;
}

TEST(ClearanceTable, SubtractsNoLessThanBodiesMoveAndLittleMore) {
  Random random(1);
  const std::vector<Family> families = {
      {1e-3, 1e-3, 1.0, 1.0, false}, {0.05, 0.02, 2.0, 1.0, false}, {0.3, 0.3, 2.0, 5.0, false},
      {3.0, 1.0, 1.0, 1.0, false},   {1e-7, 1e-8, 1.0, 1.0, false}, {1e-2, 1e-1, 1.0, 100.0, true},
      {1e-3, 1e-3, 1.0, 1e5, false}, {0.1, 0.0, 3.0, 0.0, false},   {0.0, 0.05, 3.0, 0.0, false},
      {2.0, 3.0, 1.0, 1e3, true},
  };
  double worst = 0.0, loosest = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    const Family& family = families[std::size_t(trial) % families.size()];
    const Scene scene = balls(11, random);
    const int steps = 1 + trial / 10 % 3;
    const CycleMotion motion = motionOf(family, 11, steps, random);
    const CycleMotion before = restAt(motion);
    const std::vector<char> whole(scene.bodies.size(), 1);
    BodyTwists bodies(scene);
    ClearanceTable table(scene, bodies);
    std::vector<DuePair> due;
    const auto run = [&](const CycleMotion& next) {
      bodies.begin(next, whole);
      for (std::size_t k = 0; k + 1 < next.times.size(); ++k) {
        if (k > 0) bodies.step(next, k);
        if (k + 2 < next.times.size()) table.advance(bodies);
      }
      table.finish(bodies, due);
      bodies.end(next, whole);
    };
    run(before);
    ASSERT_EQ(due.size(), scene.pairs.size());  // nothing is known yet
    for (int i = 0; i < int(scene.pairs.size()); ++i) table.set(i, kClearance);
    run(before);
    ASSERT_TRUE(due.empty());
    run(motion);
    ASSERT_TRUE(due.empty());
    for (std::size_t i = 0; i < scene.pairs.size(); ++i) {
      const double used = kClearance - table.clearance(int(i));
      const Real change = largestChange(scene, scene.pairs[i], motion, random);
      ASSERT_GE(used, change) << "trial " << trial << ", pair " << i;
      const double bound = boundOf(scene, scene.pairs[i], motion);
      // Tolerance for single precision: relative to the clearance, and to the motion of each body.
      const double coarse =
          2e-6 * kClearance + 1e-5 * (family.angle * (2.0 * family.apart + 1.0) + family.shift) * steps;
      ASSERT_LE(used, 1.05 * bound + coarse) << "trial " << trial << ", pair " << i;
      if (change > 1e-4) worst = std::max(worst, double(change) / used);
      if (bound > 0.1) loosest = std::max(loosest, used / bound);
    }
  }
  EXPECT_GT(worst, 0.9);     // climbing comes close to the bound
  EXPECT_LT(loosest, 1.02);  // where the bound is large compared with the rounding of the clearance
}

TEST(ClearanceTable, KeepsAClearanceExactlyWhileNothingMoves) {
  Random random(2);
  const Scene scene = balls(9, random);
  const std::vector<char> whole(9, 1);
  const CycleMotion motion = restAt(motionOf({0.0, 0.0, 1.0, 1.0, false}, 9, 1, random));
  BodyTwists bodies(scene);
  ClearanceTable table(scene, bodies);
  std::vector<DuePair> due;
  bodies.begin(motion, whole);
  bodies.end(motion, whole);
  table.set(3, 0.123);
  const double before = table.clearance(3);
  EXPECT_LE(before, 0.123);
  for (int i = 0; i < 1000; ++i) {
    bodies.begin(motion, whole);
    table.finish(bodies, due);
    bodies.end(motion, whole);
  }
  EXPECT_EQ(table.clearance(3), before);
  EXPECT_EQ(due.size(), scene.pairs.size() - 1);
}

TEST(ClearanceTable, PairsAreDueInTheOrderOfUrgency) {
  Random random(3);
  const Scene scene = balls(9, random);
  const std::vector<char> whole(9, 1);
  const CycleMotion still = restAt(motionOf({0.0, 0.0, 1.0, 1.0, false}, 9, 1, random));
  BodyTwists bodies(scene);
  ClearanceTable table(scene, bodies);
  std::vector<DuePair> due;
  bodies.begin(still, whole);
  bodies.end(still, whole);
  const int count = int(scene.pairs.size());
  for (int i = 0; i < count; ++i) {
    table.setError(i, 1e-3 * i);
    table.set(i, 0.001 * (i - 4));  // the first five have no clearance left
  }
  table.forget(7);
  bodies.begin(still, whole);
  const SkippedPairs skipped = table.finish(bodies, due);
  ASSERT_EQ(due.size(), 6u);
  EXPECT_EQ(due[0].pair, 7);
  for (int k = 1; k < 6; ++k) EXPECT_EQ(due[std::size_t(k)].pair, k - 1);
  EXPECT_EQ(skipped.pair, count - 1);
  EXPECT_NEAR(skipped.error, 1e-3 * (count - 1), 1e-6);
}

TEST(ClearanceTable, ABodyThatIsNotFollowedMakesItsPairsDue) {
  Random random(4);
  const Scene scene = balls(9, random);
  const std::vector<char> whole(9, 1);
  const CycleMotion still = restAt(motionOf({0.0, 0.0, 1.0, 1.0, false}, 9, 1, random));
  const auto dueAfter = [&](const CycleMotion& motion) {
    BodyTwists bodies(scene);
    ClearanceTable table(scene, bodies);
    std::vector<DuePair> due;
    bodies.begin(still, whole);
    bodies.end(still, whole);
    for (int i = 0; i < int(scene.pairs.size()); ++i) table.set(i, 1.0);
    bodies.begin(motion, whole);
    table.finish(bodies, due);
    for (const DuePair& next : due) {
      const PlannedPair& pair = scene.pairs[std::size_t(next.pair)];
      EXPECT_TRUE(pair.body_a == 4 || pair.body_b == 4);
      EXPECT_EQ(table.clearance(next.pair), 1.0);  // unchanged, for the pair's checker
    }
    return due.size();
  };
  std::size_t pairs = 0;
  for (const PlannedPair& pair : scene.pairs) pairs += pair.body_a == 4 || pair.body_b == 4;
  EXPECT_EQ(dueAfter(still), 0u);
  CycleMotion jump = still, away = still, skewed = still, nan = still, lost = still, vague = still;
  for (Isometry3d& X : jump.X_WB[4]) X.translation().x() += 1e-12;
  EXPECT_EQ(dueAfter(jump), pairs);
  away.X_WB[4][1].translation().x() = 2e8;
  EXPECT_EQ(dueAfter(away), pairs);
  skewed.X_WB[4][1].linear() *= 1.0 + 1e-6;
  EXPECT_EQ(dueAfter(skewed), pairs);
  nan.X_WB[4][1](0, 3) = std::nan("");
  EXPECT_EQ(dueAfter(nan), pairs);
  lost.missing.resize(9);
  lost.missing[4] = "lost";
  EXPECT_EQ(dueAfter(lost), pairs);
  vague.motion_error.assign(9, 0.0);
  vague.motion_error[4] = 1.001;
  EXPECT_EQ(dueAfter(vague), pairs);
  vague.motion_error[4] = 0.999;
  EXPECT_EQ(dueAfter(vague), 0u);
}

/// Of three pairs whose clearances last for one more step, for two, and for more, the first one is named. That of two
/// bodies at rest lasts for ever, however small it is.
TEST(ClearanceTable, NamesAPairThatWillBeDueSoon) {
  constexpr double kStep = 0.01;
  Random random(5);
  Scene scene;
  for (int i = 0; i < 4; ++i) {
    Body body;
    body.ball.radius = 0.1;
    scene.bodies.push_back(body);
  }
  scene.pairs = {{0, 1, true, true}, {0, 2, true, true}, {0, 3, true, true}, {1, 2, true, true}};
  const std::vector<char> whole(4, 1);
  const CycleMotion still = restAt(motionOf({0.0, 0.0, 1.0, 0.0, false}, 4, 1, random));
  const auto dueNextWith = [&](double first, double second, double third, bool is_second_paused = false) {
    BodyTwists bodies(scene);
    ClearanceTable table(scene, bodies);
    std::vector<DuePair> due;
    bodies.begin(still, whole);
    bodies.end(still, whole);
    table.pauseDueNext(0);
    table.set(0, first);
    table.set(1, second);
    if (is_second_paused) table.pauseDueNext(1);
    table.set(2, third);
    table.set(3, 1e-6);
    CycleMotion moves = still;
    moves.X_WB[0][1].translation().x() += kStep;
    bodies.begin(moves, whole);
    const int due_next = table.finish(bodies, due).due_next;
    EXPECT_TRUE(due.empty());
    return due_next;
  };
  EXPECT_EQ(dueNextWith(2.9 * kStep, 1.9 * kStep, 9.0 * kStep), 1);
  EXPECT_EQ(dueNextWith(2.9 * kStep, 9.0 * kStep, 9.0 * kStep), 0);
  EXPECT_EQ(dueNextWith(2.9 * kStep, 1.9 * kStep, 9.0 * kStep, true), 0);
  EXPECT_EQ(dueNextWith(3.1 * kStep, 9.0 * kStep, 9.0 * kStep), -1);
}

/// As after the world has lost its last body: undefined behaviour only sanitizers see.
TEST(ClearanceTable, OfNoPairsNoneIsDue) {
  const Scene scene;
  BodyTwists bodies(scene);
  ClearanceTable table(scene, bodies);
  std::vector<DuePair> due(1);
  table.advance(bodies);
  EXPECT_EQ(table.finish(bodies, due).pair, -1);
  EXPECT_TRUE(due.empty());
}

/// A pair that is due and not tested, since it is postponed, may overlap by what its bodies have moved since: by more
/// from cycle to cycle, also where they move by less than single precision can tell.
TEST(ClearanceTable, WhatIsOverdrawnBecomesNoLess) {
  Random random(3);
  for (const double shift : {1e-10, 1e-8, 1e-6, 1e-3}) {
    const Scene scene = balls(11, random);
    const Family family = {0.0, shift, 1.0, 0.0, false};
    const std::vector<char> whole(scene.bodies.size(), 1);
    BodyTwists bodies(scene);
    ClearanceTable table(scene, bodies);
    std::vector<DuePair> due;
    const std::size_t pairs = scene.pairs.size();
    const double known = -0.7;
    std::vector<double> clearance(pairs, known);
    std::vector<Real> least(pairs, known);  // how far apart balls are at least, from the motions themselves
    CycleMotion motion = motionOf(family, 11, 1, random);
    for (int cycle = 0; cycle < 300; ++cycle) {
      bodies.begin(motion, whole);
      table.finish(bodies, due);
      bodies.end(motion, whole);
      ASSERT_EQ(due.size(), pairs);
      for (const DuePair& pair : due) {
        const auto i = std::size_t(pair.pair);
        const auto way = [&](int body) {
          const std::vector<Isometry3d>& X = motion.X_WB[std::size_t(body)];
          return Vector3d(X[1].translation() - X[0].translation());
        };
        if (cycle > 0) {  // before, nothing is known
          least[i] -= (way(scene.pairs[i].body_a) - way(scene.pairs[i].body_b)).norm();
          clearance[i] = pair.left;
        }
        table.set(pair.pair, clearance[i]);
      }
      for (std::vector<Isometry3d>& X_WB : motion.X_WB) {  // goes on as before
        const Vector3d way = X_WB[1].translation() - X_WB[0].translation();
        X_WB[0] = X_WB[1];
        X_WB[1].translation() += way;
      }
    }
    for (std::size_t i = 0; i < pairs; ++i) {
      EXPECT_LE(clearance[i], least[i]) << shift;
      EXPECT_GE(clearance[i], double(least[i]) - 1e-3) << shift;
    }
  }
}

}  // namespace sdf_ccd::clearance_table_test
