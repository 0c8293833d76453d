#include "monitor/cycle_safety.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace sdf_ccd::cycle_safety_test {

CycleResult resultWith(Verdict verdict) {
  CycleResult result;
  result.pairs.resize(1);
  result.pairs[0].verdict = result.verdict = verdict;
  result.checked = 1;
  return result;
}

PairDistance pairAt(double width, double time = 0.0) {
  PairDistance pair;
  pair.pair = 0;
  pair.any.width = width;
  pair.time = time;
  return pair;
}

/// Judged with a stop distance of 2 cm and a velocity scale.
class CycleSafetyTest : public ::testing::Test {
 protected:
  CycleSafety judge(const CycleResult& result, const std::vector<PairDistance>& near, double oldest = 0.0,
                    bool has_unknown = false) {
    StoppingPromise promise;
    promise.stop_distance = 0.02;
    SafetyMemory memory;
    return judgeCycle({result, near, has_unknown, 0.0, oldest}, {{0.05, 0.02, 0.005}, promise, traits_}, memory);
  }

  void expectStop(const CycleSafety& safety, CycleFinding finding, Health health) {
    EXPECT_EQ(safety.velocity_scale, 0.0);
    EXPECT_EQ(safety.proximity, Proximity::kStop);
    EXPECT_EQ(safety.finding, finding);
    EXPECT_EQ(safety.health, health);
  }

  std::vector<PairTraits> traits_;
};

TEST_F(CycleSafetyTest, WhatIsNotKnownToBeClearStopsTheRobot) {
  expectStop(judge({}, {}), CycleFinding::kNoPair, Health::kError);
  expectStop(judge(resultWith(Verdict::kContact), {}), CycleFinding::kContact, Health::kOk);
  expectStop(judge(resultWith(Verdict::kUncertain), {}), CycleFinding::kUncertain, Health::kOk);
  CycleResult result = resultWith(Verdict::kNotChecked);
  expectStop(judge(result, {}), CycleFinding::kNotChecked, Health::kError);  // as a zeroed result says
  result.not_checked = 1;
  expectStop(judge(result, {}), CycleFinding::kNotChecked, Health::kError);
  result.verdict = Verdict::kContact;
  expectStop(judge(result, {}), CycleFinding::kContact, Health::kError);  // and one is not checked
  expectStop(judge(resultWith(Verdict::kClear), {}, 0.0, true), CycleFinding::kUnmeasured, Health::kWarn);
  expectStop(judge(resultWith(Verdict::kClear), {}, 0.21), CycleFinding::kOld, Health::kWarn);
  expectStop(judge(resultWith(Verdict::kClear), {}, std::nan("")), CycleFinding::kOld, Health::kWarn);
}

TEST_F(CycleSafetyTest, WhileNoCycleRunsTheRobotStops) {
  SafetyMemory memory;
  StoppingPromise promise;
  expectStop(judgeNoCycle({{0.05, 0.02, 0.005}, promise, traits_}, memory), CycleFinding::kNoPair, Health::kError);
  const CycleSafety made;
  EXPECT_EQ(made.finding, CycleFinding::kNoPair);
  EXPECT_EQ(made.health, Health::kError);
  EXPECT_FALSE(judgeNoCycle({{}, {}, traits_}, memory).velocity_scale);
  EXPECT_EQ(judgeNoCycle({{}, {}, traits_}, memory).proximity, Proximity::kNotWatched);
}

TEST_F(CycleSafetyTest, AClearRobotMoves) {
  const CycleSafety safety = judge(resultWith(Verdict::kClear), {pairAt(3.0)}, 0.1);
  EXPECT_EQ(safety.velocity_scale, 1.0);
  EXPECT_EQ(safety.proximity, Proximity::kFree);
  EXPECT_EQ(safety.finding, CycleFinding::kClear);
  EXPECT_EQ(safety.health, Health::kOk);
  EXPECT_EQ(judge(resultWith(Verdict::kClear), {pairAt(0.04)}).proximity, Proximity::kWarning);
  EXPECT_EQ(judge(resultWith(Verdict::kClear), {pairAt(0.01)}).proximity, Proximity::kStop);
}

/// As the lag of transforms does not stop a robot.
TEST_F(CycleSafetyTest, ADelayedPairCountsWithItsAge) {
  CycleResult result = resultWith(Verdict::kNotChecked);
  result.delayed = 1;
  result.checked = 0;
  const CycleSafety late = judge(result, {pairAt(0.5, -0.1)}, 0.1);
  EXPECT_EQ(late.finding, CycleFinding::kDelayed);
  EXPECT_EQ(late.health, Health::kWarn);
  EXPECT_EQ(late.proximity, Proximity::kFree);
  EXPECT_GT(*late.velocity_scale, 0.0);
  EXPECT_LT(*late.velocity_scale, *judge(resultWith(Verdict::kClear), {pairAt(0.5)}).velocity_scale);
  ASSERT_TRUE(late.limiting);
  expectStop(judge(result, {pairAt(0.5, -0.21)}, 0.21), CycleFinding::kOld, Health::kWarn);
  expectStop(judge(result, {pairAt(0.5)}, 0.1, true), CycleFinding::kUnmeasured, Health::kWarn);
  result.not_checked = 1;
  expectStop(judge(result, {pairAt(0.5)}, 0.1), CycleFinding::kNotChecked, Health::kError);
}

TEST_F(CycleSafetyTest, PairsCanHaveTheirOwnStopDistance) {
  traits_ = {PairTraits()};
  traits_[0].is_own = true;
  traits_[0].stop_distance = 0.005;
  const CycleSafety near = judge(resultWith(Verdict::kClear), {pairAt(0.01)});
  EXPECT_EQ(near.proximity, Proximity::kWarning);
  EXPECT_EQ(near.velocity_scale, 1.0);
  const SafetyRules rules{{0.0, 0.0, 0.0}, {}, traits_};
  EXPECT_TRUE(rules.watchesProximity());
  EXPECT_DOUBLE_EQ(safetyRange(rules), 0.005);
  EXPECT_TRUE(isTooClose(pairAt(0.005), rules));
  EXPECT_FALSE(isTooClose(pairAt(0.006), rules));
  traits_[0].is_constant = true;
  EXPECT_FALSE(isTooClose(pairAt(0.005), rules));
  EXPECT_EQ(judge(resultWith(Verdict::kClear), {pairAt(0.004)}).proximity, Proximity::kFree);
}

TEST_F(CycleSafetyTest, WithoutAnyThresholdNoDistanceIsNeeded) {
  EXPECT_EQ(safetyRange({{}, {}, traits_}), 0.0);
  EXPECT_DOUBLE_EQ(safetyRange({{0.1, 0.02, 0.01}, {}, traits_}), 0.11);
  StoppingPromise promise;
  EXPECT_DOUBLE_EQ(safetyRange({{0.1, 0.02, 0.01}, promise, traits_}), scaleRange(promise, 0.02));
}

TEST_F(CycleSafetyTest, TextsSayWhatHolds) {
  StoppingPromise promise;
  const SafetyRules rules{{}, promise, traits_};
  EXPECT_EQ(rangeText(rules),
            "velocity_scale: a robot at rest gets 0 where something of the world is closer than 112 mm, and 1 where "
            "everything is farther than 650 mm; pairs of its own links limit while they close");
  EXPECT_EQ(promiseText(promise).find("if nothing but the robot moves"), 0u);
  EXPECT_NE(promiseText(promise).find("of its own links nothing is promised (a table in the URDF is one)"),
            std::string::npos);
  promise.own_pairs = OwnPairs::kPromise;
  EXPECT_EQ(promiseText(promise).find("nothing is promised"), std::string::npos);
  EXPECT_NE(promiseText(promise).find("if each joint keeps to the scale times its limit of speed"), std::string::npos);
}

}  // namespace sdf_ccd::cycle_safety_test
