#include "monitor/resting_answers.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "monitor/pair_times.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::resting_answers_test {

using namespace test;

/// Two bodies at a constant pose relative to each other, on something that moves and turns.
CycleMotion together(double from, double until, const Isometry3d& X_AB) {
  const auto at = [](double s) {
    return translation({s, 0.2, 0.1}) * Eigen::AngleAxisd(0.5 * s, Vector3d(1, 2, 3).normalized());
  };
  std::vector<Isometry3d> X_WA, X_WB;
  for (int k = 0; k <= 4; ++k) {
    X_WA.push_back(Isometry3d(at(from + 0.25 * k * (until - from))));
    X_WB.push_back(X_WA.back() * X_AB);
  }
  return cycle(0.1, {X_WA, X_WB});
}

SceneDescription twoBoxes() {
  return {{body("a", meshShape(boxMesh({0.1, 0.1, 0.1}))), body("b", meshShape(boxMesh({0.1, 0.1, 0.1})))}, {}};
}

TEST(RestingAnswers, SayWhatATestOfTheMotionSays) {
  const auto scene = build(twoBoxes());
  const auto tested = std::make_shared<Scene>(*scene);
  tested->resting = nullptr;
  Monitor once(scene, soft()), always(tested, soft());
  CycleRequest request;
  request.max_points = 5;
  for (const double x : {0.0, 0.15, 0.1999, 0.2, 0.20004, 0.21}) {
    const Isometry3d X_AB = translation({x, 0.01, 0.02});
    for (int i = 0; i < 4; ++i) {
      const CycleMotion motion = together(0.1 * i, 0.1 * (i + 1), X_AB);
      const CycleResult a = once.run(motion, request), b = always.run(motion, request);
      const PairResult &known = a.pairs[0], &found = b.pairs[0];
      ASSERT_EQ(known.verdict, found.verdict) << x << " " << i;
      EXPECT_LE(known.error.total(), found.error.total() + 1e-6) << x;
      if (known.verdict != Verdict::kContact) continue;
      EXPECT_NEAR(known.intervals.front().enter, 0.0, 1e-9);
      EXPECT_NEAR(known.intervals.back().exit, 0.1, 1e-9);
      EXPECT_NEAR(known.deepest.depth, found.deepest.depth, found.deepest.depth_error) << x;
      // Whichever of the deepest points it is: it lies in both boxes then.
      const std::size_t k = 4;
      const Isometry3d X_AW = motion.X_WB[0][k].inverse();
      if (known.deepest.time == 0.1) {
        EXPECT_LT((X_AW * known.deepest.p_W).lpNorm<Eigen::Infinity>(), 0.1 + 1e-6);
      }
      EXPECT_NEAR((known.on_a_W.force - found.on_a_W.force).norm(), 0.0, 1e-3 * found.on_a_W.force.norm() + 1e-6) << x;
      EXPECT_NEAR((known.on_b_W.torque - found.on_b_W.torque).norm(), 0.0, 2e-3 * found.on_b_W.torque.norm() + 1e-3)
          << x;
    }
  }
}

/// A pair's answer that nobody would find otherwise.
std::shared_ptr<RestingAnswer> marked(const Isometry3d& X_AB, const MonitorOptions& options) {
  auto answer = std::make_shared<RestingAnswer>();
  answer->X_AB = X_AB;
  answer->error = RestingAnswers::errorFor(RestingAnswers::kMoved);
  answer->options = options;
  answer->result.verdict = Verdict::kContact;
  answer->result.intervals = {{0.0, 1.0}};
  answer->result.deepest.depth = 0.0123;
  return answer;
}

TEST(RestingAnswers, AreUsedByAllMonitorsOfAScene) {
  const Isometry3d X_AB = translation({0.15, 0, 0});
  const MonitorOptions options;
  const auto scene = build(twoBoxes());
  scene->resting->keep({scene->bodies.shared(0), scene->bodies.shared(1)}, marked(X_AB, options));
  const auto depthOf = [](Monitor& monitor, const CycleMotion& motion) {
    return monitor.run(motion, {}).pairs[0].deepest.depth;
  };
  Monitor first(scene, options), second(scene, options);
  EXPECT_EQ(depthOf(first, together(0.0, 0.1, X_AB)), 0.0123);
  EXPECT_EQ(depthOf(second, together(0.3, 0.4, X_AB)), 0.0123);
  EXPECT_NE(depthOf(first, together(0.1, 0.2, translation({0.15 + 1e-6, 0, 0}))), 0.0123) << "elsewhere";
  CycleMotion apart = together(0.1, 0.2, X_AB);
  apart.X_WB[1].back() = apart.X_WB[1].back() * translation({1e-6, 0, 0});
  EXPECT_NE(depthOf(second, apart), 0.0123) << "not at rest";
  CycleMotion unsure = together(0.1, 0.2, X_AB);
  unsure.motion_error = {1e-3, 0.0};
  EXPECT_NE(depthOf(first, unsure), 0.0123) << "a contact that a larger error may contradict";
  MonitorOptions others;
  others.max_error = 2e-4;
  Monitor third(scene, others);
  EXPECT_NE(depthOf(third, together(0.0, 0.1, X_AB)), 0.0123) << "of other options";
}

TEST(RestingAnswers, StayWhileTheSceneChangesAroundTheirBodies) {
  const Isometry3d X_AB = translation({0.15, 0, 0});
  WorldEditor editor(fine());
  SceneDescription description = twoBoxes();
  const auto before = editor.next(description)->scene;
  before->resting->keep({before->bodies.shared(0), before->bodies.shared(1)}, marked(X_AB, {}));
  description.bodies.push_back(body("table", Primitive(Box::fromSize({2, 2, 0.2})), true));
  const auto after = editor.next(description)->scene;
  Monitor monitor(after, {});
  CycleMotion motion = together(0.0, 0.1, X_AB);
  motion.X_WB.push_back({translation({0, 0, -5})});
  const CycleResult& result = monitor.run(motion, {});
  for (const PairResult& pair : result.pairs)
    if (pair.body_b == 1) {
      EXPECT_EQ(pair.deepest.depth, 0.0123);
    }
}

/// As a bellows that is part of two links: it can never be told whether these touch.
TEST(RestingAnswers, OfIdenticalMeshesAreFoundOnce) {
  const Shape bellows = meshShape(torusMesh(0.3, 0.1, 48, 24));
  const auto scene = build(SceneDescription{{body("a", bellows), body("b", bellows)}, {}});
  Monitor monitor(scene, {});
  PairTimes times(1);
  CycleRequest request;
  request.times = &times;
  for (int i = 0; i < 3; ++i) {
    const CycleResult& result = monitor.run(together(0.1 * i, 0.1 * (i + 1), Isometry3d::Identity()), request);
    EXPECT_TRUE(mayTouch(result.verdict));
    const auto known = scene->resting->find({scene->bodies.shared(0), scene->bodies.shared(1)}, Isometry3d::Identity(),
                                            0.0, request, {});
    ASSERT_EQ(known != nullptr, i > 0) << "once they have rested for two cycles";
    if (known) {
      EXPECT_EQ(known->result.verdict, result.verdict);
    }
  }
  EXPECT_EQ(times.longest(*scene), "a - b (100 %)");
  // What moves is tested again.
  EXPECT_EQ(monitor.run(together(0.0, 0.1, translation({0, 0, 0.21})), {}).verdict, Verdict::kClear);
  EXPECT_EQ(monitor.run(together(0.0, 0.1, translation({0, 0, 0.19})), {}).verdict, Verdict::kContact);
}

/// As in queries, each of which has a monitor of its own for a single cycle.
TEST(RestingAnswers, AreThoseOfOtherMonitorsOfTheScene) {
  const Shape bellows = meshShape(torusMesh(0.3, 0.1, 48, 24));
  const auto scene = build(SceneDescription{{body("a", bellows), body("b", bellows)}, {}});
  const auto isKnown = [&](const Isometry3d& X_AB) {
    return scene->resting->find({scene->bodies.shared(0), scene->bodies.shared(1)}, X_AB, 0.0, {}, {}) != nullptr;
  };
  const Isometry3d elsewhere = translation({0, 0, 0.001});
  for (const Isometry3d& X_AB : {Isometry3d::Identity(), elsewhere, Isometry3d::Identity(), Isometry3d::Identity()}) {
    EXPECT_FALSE(isKnown(X_AB)) << "bodies that only turn round are not answered for nothing";
    EXPECT_TRUE(mayTouch(Monitor(scene, {}).run(together(0.0, 0.1, X_AB), {}).verdict));
  }
  EXPECT_TRUE(isKnown(Isometry3d::Identity()));
  EXPECT_FALSE(isKnown(elsewhere));
}

/// Errors of poses change from cycle to cycle, and an answer must not tell less than a test of the cycle would.
TEST(RestingAnswers, TellAsMuchAsTheErrorOfTheCycleAllows) {
  const auto scene = build(twoBoxes());
  const auto tested = std::make_shared<Scene>(*scene);
  tested->resting = nullptr;
  for (const double gap : {-0.05, -1e-3, 1e-3, 0.04}) {
    Monitor once(scene, {}), always(tested, {});
    int uncertain = 0;
    for (const double error : {0.05, 0.05, 0.03, 0.06, 1e-3, 1e-5, 0.0011, 0.06, 0.0, 0.0, 1e-5, 0.05}) {
      CycleMotion motion = together(0.0, 0.1, translation({0.2 + gap, 0.01, 0.02}));
      motion.motion_error = {0.0, error};
      const CycleResult &known = once.run(motion, {}), &found = always.run(motion, {});
      ASSERT_EQ(known.verdict, found.verdict) << gap << " " << error;
      EXPECT_NEAR(known.error_bound, found.error_bound, 1e-6) << gap << " " << error;
      uncertain += known.verdict == Verdict::kUncertain;
    }
    EXPECT_GT(uncertain, 0) << gap;
    EXPECT_LT(uncertain, 12) << gap;
  }
}

}  // namespace sdf_ccd::resting_answers_test
