#include "monitor/join_results.h"

#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::join_results_test {

using namespace test;

/// A ball that passes through a block twice, rotating.
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

/// In the first piece a point only touches; in the second one the surfaces cross without shell points inside.
TEST(ResultJoiner, TheBoundOfAHiddenDepthIsKept) {
  const CycleMotion motion = cycle(1.0, {still(Isometry3d::Identity()), still(Isometry3d::Identity())});
  ResultJoiner joiner(5);
  for (const double depth_error : {1e-17, 1e-3}) {
    CycleResult piece;
    piece.pairs.resize(1);
    PairResult& pair = piece.pairs[0];
    pair.body_a = 0;
    pair.body_b = 1;
    pair.verdict = Verdict::kContact;
    pair.span = {0, 1};
    pair.intervals = {{0.2, 0.3}};
    pair.deepest.depth_error = depth_error;
    joiner.add(motion, piece);
  }
  EXPECT_EQ(joiner.result().pairs[0].deepest.depth_error, 1e-3);
}

TEST(ResultJoiner, PiecesTogetherSayWhatTheWholeSays) {
  const auto scene =
      build({body("ball", Primitive(Sphere{0.1})), body("block", Primitive(Box::fromSize({0.1, 0.8, 0.7})), true)},
            fine(0.01));
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
  EXPECT_NEAR(a.deepest.depth, b.deepest.depth, b.deepest.depth_error);  // it is as deep on the way back
  EXPECT_EQ(a.points.size(), 5u);
  const double force = b.on_a_W.force.norm();
  EXPECT_GT(force, 1.0);
  EXPECT_LT((a.on_a_W.force - b.on_a_W.force).norm(), 1e-6 * force);
  EXPECT_LT((a.on_a_W.torque - b.on_a_W.torque).norm(), 1e-6 * force);
  EXPECT_LT((a.on_b_W.torque - b.on_b_W.torque).norm(), 1e-6 * force);
  EXPECT_NEAR(joiner.motion().times[1], 4.0, 1e-12);
}

/// Joins pieces of two seconds each.
CycleResult joined(Monitor& monitor, const CycleMotion& motion, const CycleRequest& request) {
  ResultJoiner joiner(0);
  for (std::size_t first = 0; first + 1 < motion.times.size(); first += 2) {
    const CycleMotion part = piece(motion, first, std::min(first + 2, motion.times.size() - 1));
    joiner.add(part, monitor.run(part, request));
  }
  return joiner.result();
}

/// A cube with a corner pointing down, kCorner below its centre.
constexpr double kHalf = 0.05;
const double kCorner = std::sqrt(3.0) * kHalf, kEdge = std::sqrt(2.0) * kHalf;
Isometry3d onCorner() {
  return pose(Vector3d::Zero(), std::acos(1.0 / std::sqrt(3.0)), {1, -1, 0});
}

TEST(ResultJoiner, WhatAnUncertainPieceMayTouchIsNotApart) {
  const TriangleMesh cube = boxMesh({kHalf, kHalf, kHalf});
  const auto scene = build({body("ridge", meshShape(cube)), body("cube", meshShape(cube))}, optionsForContacts());
  const auto at = [](double y, double height) {
    return translation({0.0123, y, kEdge + kCorner + height}) * onCorner();
  };
  // Its corner touches the edge as it passes over; later it lands on the edge.
  std::vector<Isometry3d> poses{at(-0.0313, 0.0), at(0.0517, 0.0)};
  for (int i = 0; i < 9; ++i) poses.push_back(at(0.0517, 0.05 + 0.001 * i));
  poses.push_back(at(0.0, 0.05));
  poses.push_back(at(0.0, -0.003));
  const CycleMotion motion = cycle(double(poses.size() - 1),
                                   {std::vector<Isometry3d>(poses.size(), pose({0, 0, 0}, kPi / 4, {1, 0, 0})), poses});
  Monitor monitor(scene, soft());
  const PairResult pair = joined(monitor, motion, {}).pairs[0];
  ASSERT_TRUE(pair.first_touch);
  EXPECT_LE(pair.first_touch->enter, 0.0313 / 0.083);
  EXPECT_GE(pair.first_touch->exit, 11.0);  // it was uncertain at first
}

TEST(ResultJoiner, NoPieceIsDeeperThanTheWholeSays) {
  const auto scene = build(
      {body("slab", meshShape(boxMesh({0.3, 0.3, kHalf}))), body("cube", meshShape(boxMesh({kHalf, kHalf, kHalf})))},
      optionsForContacts());
  for (const double max_error : {1e-2, 1e-4}) {
    MonitorOptions options = soft();
    options.max_error = max_error;
    const double first = 0.012, second = first + 0.45 * max_error, arm = 0.2 + kCorner;
    const double half_angle = std::acos((arm - (second - (first - 0.01 * max_error))) / arm);
    const auto at = [&](double depth, double angle) {
      return translation({0.013, 0.021, kHalf - depth + arm}) * pose({0, 0, 0}, angle, {0, 1, 0}) *
             translation({0, 0, -0.2}) * onCorner();
    };
    // One piece ends exactly at its deepest time; the next one swings through a little deeper.
    const std::vector<Isometry3d> poses{at(first - 1e-3, 0.0), at(first, 0.0), at(first - 1e-3, 0.0),
                                        at(second, -half_angle), at(second, half_angle)};
    const CycleMotion motion = cycle(4.0, {std::vector<Isometry3d>(poses.size(), Isometry3d::Identity()), poses});
    Monitor monitor(scene, options);
    const ContactPoint deepest = joined(monitor, motion, {}).pairs[0].deepest;
    EXPECT_GE(deepest.depth + deepest.depth_error, second - 1e-9) << max_error;
  }
}

TEST(ResultJoiner, WhatOnePieceDoesNotKnowTheWholeDoesNotKnow) {
  const auto scene =
      build({body("ball", Primitive(Sphere{0.1})), body("block", Primitive(Box::fromSize({0.1, 0.1, 0.1})), true)},
            fine(0.01));
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

}  // namespace sdf_ccd::join_results_test
