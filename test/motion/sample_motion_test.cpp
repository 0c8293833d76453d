#include "motion/sample_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "motion/chain_derivatives.h"

namespace sdf_ccd::sample_motion_test {

using Eigen::AngleAxisd;

/// The hand of an arm whose two crossing joints rotate uniformly by 0.4 rad in a second: not a screw motion.
Isometry3d hand(double time) {
  const Isometry3d X_base(AngleAxisd(0.4 * time, Vector3d::UnitZ()));
  const Isometry3d X_elbow(Eigen::Translation3d(0.5, 0.0, 0.0) * AngleAxisd(0.4 * time, Vector3d::UnitY()));
  return X_base * X_elbow * Eigen::Translation3d(0.3, 0.0, 0.0);
}

/// Bound of the hand's third derivative over a time in which both joints rotate by `angle`: its ball lies 0.3 m beyond
/// the elbow, which is 0.5 m from the base.
double handJerk(const DerivativeBounds& angle) {
  ChainDerivatives chain({Vector3d(0.3, 0.0, 0.0), 0.1});
  chain.addFrame(0.5, angle, {});
  chain.addFrame(0.0, angle, {});
  return chain.jerk();
}

const MotionSource kHandAndRest = {[](double time, std::vector<Isometry3d>& X_WB) {
                                     X_WB = {hand(time), Isometry3d::Identity()};
                                   },
                                   [](double start, double end, std::vector<double>& jerk) {
                                     jerk = {handJerk({0.4 * (end - start)}), 0.0};
                                   }};
const std::vector<BoundingBall> kBalls = {{Vector3d::Zero(), 0.1}, {Vector3d::Zero(), 1.0}};

double worstDeviation(const CycleMotion& motion) {
  double worst = 0.0;
  for (std::size_t i = 0; i + 1 < motion.times.size(); ++i) {
    const ScrewMotion screw(motion.X_WB[0][i], motion.X_WB[0][i + 1]);
    for (int k = 0; k <= 50; ++k) {
      const double s = k / 50.0;
      const double time = (1.0 - s) * motion.times[i] + s * motion.times[i + 1];
      const Isometry3d X_true = hand(time);
      for (const Vector3d& p : {Vector3d(0.1, 0, 0), Vector3d(0, -0.1, 0), Vector3d(0, 0, 0.1)}) {
        worst = std::max(worst, (screw.pose(s) * p - X_true * p).norm());
      }
    }
  }
  return worst;
}

TEST(SampleMotion, HalvesUntilTheScrewIsWithinTolerance) {
  CycleMotion motion;
  sampleMotion({0.0, 0.3, 1.0}, kHandAndRest, kBalls, {1e-4, 8}, motion);
  ASSERT_GT(motion.times.size(), 3u);
  EXPECT_EQ(motion.times.front(), 0.0);
  EXPECT_EQ(motion.times.back(), 1.0);
  EXPECT_TRUE(std::is_sorted(motion.times.begin(), motion.times.end()));
  EXPECT_TRUE(std::find(motion.times.begin(), motion.times.end(), 0.3) != motion.times.end());
  EXPECT_EQ(motion.motion_error[1], 0.0);
  EXPECT_LE(motion.motion_error[0], 1e-4);
  // The error that is reported holds, and is no more than a few times the true one.
  const double worst = worstDeviation(motion);
  EXPECT_LE(worst, motion.motion_error[0]);
  EXPECT_GE(worst, 0.3 * motion.motion_error[0]);
}

TEST(SampleMotion, ReportsWhatIsLeftWhenHalvingEnds) {
  CycleMotion motion;
  sampleMotion({0.0, 1.0}, kHandAndRest, kBalls, {1e-6, 0}, motion);
  EXPECT_EQ(motion.times.size(), 2u);
  EXPECT_GT(motion.motion_error[0], 1e-4);
  EXPECT_LE(worstDeviation(motion), motion.motion_error[0]);
}

/// One joint with quintic timing: in the middle it is where it would be if it rotated uniformly.
TEST(SampleMotion, ADeviationThatTheMiddleDoesNotShowIsInTheBound) {
  constexpr double kAngle = 1.5;
  const auto hand = [](double s) {
    const double law = s * s * s * (10.0 + s * (-15.0 + 6.0 * s));
    return Isometry3d(AngleAxisd(kAngle * law, Vector3d::UnitZ()) * Eigen::Translation3d(0.8, 0.0, 0.0));
  };
  const MotionSource source = {
      [&](double time, std::vector<Isometry3d>& X_WB) { X_WB = {hand(time)}; },
      [](double start, double end, std::vector<double>& jerk) {
        // The law's derivatives are at most 15/8, 10/√3 and 60.
        const double h = end - start;
        const DerivativeBounds angle{1.875 * kAngle * h, 5.774 * kAngle * h * h, 60.0 * kAngle * h * h * h};
        ChainDerivatives chain({Vector3d(0.8, 0.0, 0.0), 0.05});
        chain.addFrame(0.0, angle, {});
        jerk = {chain.jerk()};
      }};
  CycleMotion motion;
  for (const int halvings : {0, 1, 3, 8}) {
    sampleMotion({0.0, 1.0}, source, {{Vector3d::Zero(), 0.05}}, {1e-4, halvings}, motion);
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < motion.times.size(); ++i) {
      const ScrewMotion screw(motion.X_WB[0][i], motion.X_WB[0][i + 1]);
      for (int k = 0; k <= 200; ++k) {
        const double s = k / 200.0, time = (1.0 - s) * motion.times[i] + s * motion.times[i + 1];
        worst = std::max(worst, (screw.pose(s).translation() - hand(time).translation()).norm());
      }
    }
    EXPECT_LE(worst, motion.motion_error[0]) << halvings;
    EXPECT_TRUE(halvings > 0 || worst > 0.1) << worst;
    EXPECT_TRUE(halvings < 8 || motion.motion_error[0] <= 1e-4) << motion.motion_error[0];
  }
}

TEST(SampleMotion, WithoutABoundNothingIsKnown) {
  const MotionSource source = {kHandAndRest.poses_at, [](double, double, std::vector<double>&) {}};
  CycleMotion motion;
  sampleMotion({0.0, 1.0}, source, kBalls, {1e-4, 2}, motion);
  EXPECT_TRUE(std::isinf(motion.motion_error[0]));
}

TEST(SampleMotion, LeavesMissingBodiesAlone) {
  CycleMotion motion;
  motion.missing = {"no transform", ""};
  sampleMotion({0.0, 1.0}, kHandAndRest, kBalls, {1e-6, 5}, motion);
  EXPECT_EQ(motion.times.size(), 2u);
  EXPECT_EQ(motion.motion_error[0], 0.0);
}

TEST(SampleMotion, AShorterMotionReusesTheMemoryOfALongerOne) {
  CycleMotion motion;
  sampleMotion({0.0, 1.0}, kHandAndRest, kBalls, {1e-5, 8}, motion);
  sampleMotion({0.0, 0.01}, kHandAndRest, kBalls, {1e-3, 8}, motion);
  EXPECT_EQ(motion.times, (std::vector<double>{0.0, 0.01}));
  EXPECT_EQ(motion.X_WB[0].size(), 2u);
}

}  // namespace sdf_ccd::sample_motion_test
