#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "monitor/clearance_table.h"
#include "monitor/clearance_table_case.h"
#include "oracle/long_screw.h"
#include "oracle/scene_case.h"

// Pairs of moving bodies with groups of bodies that rest.

namespace sdf_ccd::resting_bodies_test {

using namespace test;

/// A few bodies of a robot among many of the world, most of which rest most of the time.
Scene robotInAWorld(Random& random) {
  const Scene all = balls(26, random);
  Scene scene;
  for (std::size_t b = 0; b < all.bodies.size(); ++b) {
    Body body = all.bodies[b];
    body.is_world = b >= 6;
    scene.bodies.push_back(body);
  }
  for (const PlannedPair& pair : all.pairs)
    if (pair.body_a < 6) scene.pairs.push_back(pair);
  return scene;
}

/// While the world rests, only the paths of the robot's bodies are added up. In 400 cycles, in which some of the world
/// moves now and then and pairs are set, forgotten and consumed, no distance changes by more than the clearance does.
TEST(RestingBodies, ClearancesAreNoLargerThanWhatIsLeft) {
  Random random(6);
  const Scene scene = robotInAWorld(random);
  const std::size_t count = scene.pairs.size();
  const std::vector<char> whole(scene.bodies.size(), 1);
  std::vector<Isometry3d> X_WB;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) X_WB.push_back(pose(random, 3.0, 2.0));
  struct Watched {
    Vector3d p_A, p_B;
    Real distance;    // when the clearance was set
    double consumed;  // since then, by consume()
    double bound;     // the smaller bound of the two balls, summed up
  };
  std::vector<Watched> watched(count);
  const auto distanceOf = [&](const PlannedPair& pair, const Watched& w) {
    const auto at = [&](int body, const Vector3d& p) {
      const Isometry3d& X = X_WB[std::size_t(body)];
      return Eigen::Matrix<Real, 3, 1>(X.linear().cast<Real>() * p.cast<Real>() + X.translation().cast<Real>());
    };
    return (at(pair.body_a, w.p_A) - at(pair.body_b, w.p_B)).norm();
  };
  BodyTwists bodies(scene);
  ClearanceTable table(scene, bodies);
  std::vector<DuePair> due;
  const auto set = [&](std::size_t i) {
    const PlannedPair& pair = scene.pairs[i];
    const auto pointOf = [&](int body) {
      const BoundingBall& ball = scene.bodies[std::size_t(body)].ball;
      return Vector3d(ball.center + ball.radius * direction(random));
    };
    watched[i] = {pointOf(pair.body_a), pointOf(pair.body_b), 0, 0.0, 0.0};
    watched[i].distance = distanceOf(pair, watched[i]);
    table.set(int(i), kClearance);
  };
  int looser = 0;
  double worst = 0.0;
  for (int cycle = 0; cycle < 400; ++cycle) {
    CycleMotion motion;
    const int steps = cycle % 13 == 0 ? 3 : 1;
    for (int k = 0; k <= steps; ++k) motion.times.push_back(k);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
      motion.X_WB.push_back({X_WB[b]});
      const bool moves = b < 6 ? random() % 10 != 0 : cycle % 50 > 40 && b == 6 + std::size_t(cycle) % 20;
      for (int k = 0; k < steps; ++k)
        motion.X_WB[b].push_back(moves ? moved(motion.X_WB[b].back(), 0.01, 0.01, random) : motion.X_WB[b].back());
    }
    bodies.begin(motion, whole);
    for (int k = 0; k < steps; ++k) {
      if (k > 0) bodies.step(motion, std::size_t(k));
      if (k + 1 < steps) table.advance(bodies);
    }
    table.finish(bodies, due);
    bodies.end(motion, whole);
    for (std::size_t b = 0; b < X_WB.size(); ++b) X_WB[b] = motion.X_WB[b].back();
    for (std::size_t i = 0; i < count; ++i) {
      if (cycle == 0 || !table.isKnown(int(i))) {
        set(i);
        continue;
      }
      Watched& w = watched[i];
      const double used = kClearance - table.clearance(int(i)) - w.consumed;
      const Real change = std::abs(distanceOf(scene.pairs[i], w) - w.distance);
      ASSERT_GE(used, change) << "cycle " << cycle << ", pair " << i;
      w.bound += boundOf(scene, scene.pairs[i], motion);
      ASSERT_LE(used, 3.0 * w.bound + 1e-3) << "cycle " << cycle << ", pair " << i;
      looser += used > 1.05 * w.bound + 1e-3;
      worst = std::max(worst, double(change) / (used + 1e-6));
      if (random() % 200 == 0) set(i);
      if (random() % 500 == 0) table.forget(int(i));
      if (random() % 100 != 0 || !table.isKnown(int(i))) continue;
      w.consumed += 0.125;
      table.consume(int(i), 0.125);
    }
  }
  EXPECT_GT(looser, 1000) << "no path was added up";
  EXPECT_GT(worst, 0.9);
}

/// Balls, of which the first moves.
class OneMoves {
 public:
  OneMoves() : scene_(threeBalls()), bodies_(scene_), table(scene_, bodies_) {}

  void cycle(double step) {
    CycleMotion motion;
    motion.times = {0.0, 1.0};
    Isometry3d next = X_;
    next.translation().x() += step;
    motion.X_WB = {{X_, next}, {away_, away_}, {away_, away_}};
    X_ = next;
    bodies_.begin(motion, whole_);
    table.finish(bodies_, due_);
    bodies_.end(motion, whole_);
  }

 private:
  static Scene threeBalls() {
    Scene scene;
    for (int i = 0; i < 3; ++i) {
      Body body;
      body.name = std::to_string(i);
      body.ball.radius = 0.1;
      body.is_world = i > 0;
      scene.bodies.push_back(body);
    }
    scene.pairs = {{0, 1, true, true}, {0, 2, true, true}};
    return scene;
  }

  Scene scene_;
  std::vector<char> whole_ = {1, 1, 1};
  Isometry3d X_ = Isometry3d::Identity(), away_ = Isometry3d(Eigen::Translation3d(0.0, 5.0, 0.0));
  std::vector<DuePair> due_;
  BodyTwists bodies_;

 public:
  ClearanceTable table;
};

/// Nothing is used up while nothing moves, also after something has.
TEST(RestingBodies, AClearanceStaysWhileNothingMoves) {
  OneMoves balls;
  balls.cycle(0.0);
  for (const int pair : {0, 1}) balls.table.set(pair, 1.0);
  balls.cycle(0.0);
  balls.cycle(0.1);
  const double after = balls.table.clearance(0);
  EXPECT_NEAR(after, 0.9, 1e-5);
  for (int i = 0; i < 100000; ++i) balls.cycle(0.0);
  EXPECT_EQ(balls.table.clearance(0), after);
}

/// Steps far below the rounding of the clearance, after each of which another pair of the block is set.
TEST(RestingBodies, TinyPathsAreUsedUp) {
  OneMoves balls;
  balls.cycle(0.0);
  for (const int pair : {0, 1}) balls.table.set(pair, 1e6);
  constexpr int kSteps = 10000;
  constexpr double kStep = 5e-11;
  for (int i = 0; i < kSteps; ++i) {
    balls.cycle(0.0);
    balls.cycle(kStep);
    balls.table.set(1, 1e6);
  }
  EXPECT_GE(1e6 - balls.table.clearance(0), kSteps * kStep);
}

/// The error bound of pairs that are not due, also where their blocks are not scanned.
TEST(RestingBodies, TheLargestErrorIsReported) {
  Random random(7);
  const Scene scene = robotInAWorld(random);
  const std::vector<char> whole(scene.bodies.size(), 1);
  const int count = int(scene.pairs.size());
  for (int trial = 0; trial < 50; ++trial) {
    BodyTwists bodies(scene);
    ClearanceTable table(scene, bodies);
    std::vector<double> errors;
    std::vector<DuePair> due;
    for (int i = 0; i < count; ++i) {
      errors.push_back(uniform(random, 0.0, 1e-3));
      table.setError(i, errors.back());
    }
    CycleMotion motion = restAt(motionOf({0.0, 0.0, 2.0, 1.0, false}, 26, 1, random));
    motion.motion_error.assign(26, 0.0);
    for (int cycle = 0; cycle < 5; ++cycle) {
      for (int b = 0; b < 26; ++b) {
        Isometry3d& X = motion.X_WB[std::size_t(b)][0];
        X = motion.X_WB[std::size_t(b)][1];
        const bool is_vague = b < 6 || trial % 3 == 0;
        if (is_vague) motion.motion_error[std::size_t(b)] = random() % 3 == 0 ? uniform(random, 0.0, 1e-3) : 0.0;
        if (!is_vague) motion.motion_error[std::size_t(b)] = trial % 3 == 1 ? 1e-3 : 0.0;
        if (b < 6) motion.X_WB[std::size_t(b)][1] = moved(X, 1e-3, 1e-3, random);
      }
      bodies.begin(motion, whole);
      const SkippedPairs skipped = table.finish(bodies, due);
      if (cycle > 0) {
        ASSERT_TRUE(due.empty());
        double largest = 0.0;
        for (int i = 0; i < count; ++i) {
          const PlannedPair& pair = scene.pairs[std::size_t(i)];
          largest = std::max(largest, errors[std::size_t(i)] + bodies.poseError(pair.body_a, pair.body_b));
        }
        ASSERT_GE(skipped.error, largest);
        ASSERT_LE(skipped.error, largest + 1e-8);
        ASSERT_GE(skipped.pair, 0);
      }
      bodies.end(motion, whole);
      for (int i = 0; i < count && cycle == 0; ++i) table.set(i, kClearance);
    }
  }
}

/// A half-space whose motion is vague strays in proportion to the distance of the other body, which is not that of a
/// body far away that is stored beside it.
TEST(RestingBodies, TheErrorIsThatOfAPair) {
  constexpr double kVague = 1e-3, kStep = 1e-3;
  const Isometry3d away = Isometry3d(Eigen::Translation3d(500.0, 0.0, 3.0));
  std::vector<BodyDescription> bodies = {body("link", Primitive(Sphere{0.1})),
                                         body("ground", Primitive(HalfSpace{Vector3d::UnitZ(), 0.0}), true),
                                         body("far", Primitive(Sphere{0.1}), true)};
  Monitor monitor(build(bodies), {});
  Isometry3d X = Isometry3d(Eigen::Translation3d(0.0, 0.0, 3.0));
  for (int i = 0; i < 4; ++i) {
    const Isometry3d from = X;
    X.translation().x() += kStep;
    CycleMotion motion = cycle(0.1, {{from, X}, still(Isometry3d::Identity()), still(away)});
    motion.motion_error = {0.0, kVague, kVague};
    const CycleResult& result = monitor.run(motion, {});
    double largest = 0.0;
    for (const PairResult& pair : result.pairs) largest = std::max(largest, pair.error.total());
    EXPECT_GE(result.error_bound, largest);
    EXPECT_LE(result.error_bound, 1.001 * largest) << "cycle " << i;
  }
}

}  // namespace sdf_ccd::resting_bodies_test
