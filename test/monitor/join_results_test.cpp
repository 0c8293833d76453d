#include "monitor/join_results.h"

#include <gtest/gtest.h>

#include "monitor/scene_case.h"

namespace sdf_ccd {
namespace {

using namespace test;

/// A ball that goes through a block twice, and turns.
CycleMotion throughAndBack() {
  std::vector<Isometry3d> ball;
  for (int i = 0; i <= 40; ++i) {
    const double x = i <= 20 ? -0.4 + 0.04 * i : 0.4 - 0.04 * (i - 20);
    ball.push_back(translation({x, 0.01 * i, 0.0}) * Eigen::AngleAxisd(0.05 * i, Vector3d::UnitZ()));
  }
  std::vector<Isometry3d> block(ball.size(), translation({0.0, 0.2, 0.3}));
  return cycle(4.0, {ball, block});
}

CycleMotion piece(const CycleMotion& whole, std::size_t first, std::size_t last) {
  CycleMotion motion;
  for (std::size_t i = first; i <= last; ++i) motion.times.push_back(whole.times[i] - whole.times[first]);
  for (const auto& poses : whole.X_WB) {
    motion.X_WB.emplace_back(poses.begin() + static_cast<long>(first), poses.begin() + static_cast<long>(last) + 1);
  }
  return motion;
}

TEST(ResultJoiner, PiecesTogetherSayWhatTheWholeSays) {
  const auto scene =
      build({body("ball", Primitive(Sphere{0.1})), body("block", Primitive(Box{{0.05, 0.4, 0.35}}), true)}, fine(0.01));
  Monitor at_once(scene, soft()), piece_by_piece(scene, soft());
  const CycleMotion motion = throughAndBack();
  const CycleRequest request{true, 5};
  const CycleResult whole = at_once.run(motion, request);
  ResultJoiner joiner(5);
  for (std::size_t first = 0; first < 40; first += 8) {
    const CycleMotion part = piece(motion, first, first + 8);
    joiner.add(part, piece_by_piece.run(part, request));
  }
  const CycleResult joined = joiner.result();
  ASSERT_EQ(joined.pairs.size(), whole.pairs.size());
  const PairResult &a = joined.pairs[0], &b = whole.pairs[0];
  EXPECT_EQ(joined.verdict, Verdict::kContact);
  EXPECT_EQ(joined.checked, 1);
  EXPECT_NEAR(joined.error_bound, whole.error_bound, 1e-8);
  ASSERT_EQ(b.intervals.size(), 2u);
  ASSERT_EQ(a.intervals.size(), b.intervals.size());
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.intervals[i].enter, b.intervals[i].enter, 1e-9);
    EXPECT_NEAR(a.intervals[i].exit, b.intervals[i].exit, 1e-9);
  }
  EXPECT_NEAR(a.deepest.depth, b.deepest.depth, 1e-9);
  EXPECT_NEAR(a.deepest.time, b.deepest.time, 0.2);  // it is as deep for a while
  EXPECT_EQ(a.points.size(), 5u);
  const double force = b.on_a_W.force.norm();
  EXPECT_GT(force, 1.0);
  EXPECT_LT((a.on_a_W.force - b.on_a_W.force).norm(), 1e-6 * force);
  EXPECT_LT((a.on_a_W.torque - b.on_a_W.torque).norm(), 1e-6 * force);
  EXPECT_LT((a.on_b_W.torque - b.on_b_W.torque).norm(), 1e-6 * force);
  EXPECT_NEAR(joiner.motion().times[1], 4.0, 1e-12);
}

TEST(ResultJoiner, WhatOnePieceDoesNotKnowTheWholeDoesNotKnow) {
  const auto scene = build(
      {body("ball", Primitive(Sphere{0.1})), body("block", Primitive(Box{{0.05, 0.05, 0.05}}), true)}, fine(0.01));
  Monitor monitor(scene, soft());
  const CycleMotion still_apart = cycle(1.0, {still(translation({1.0, 0.0, 0.0})), still(Isometry3d::Identity())});
  CycleMotion lost = still_apart;
  lost.missing = {"nobody knows", ""};
  ResultJoiner joiner(0);
  joiner.add(still_apart, monitor.run(still_apart, {}));
  joiner.add(lost, monitor.run(lost, {}));
  joiner.add(still_apart, monitor.run(still_apart, {}));
  EXPECT_EQ(joiner.result().verdict, Verdict::kNotChecked);
  EXPECT_EQ(joiner.result().pairs[0].reason, "nobody knows");
}

}  // namespace
}  // namespace sdf_ccd
