#include "sdf_ccd/scene/sample_motion.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sdf_ccd {
namespace {

using Eigen::AngleAxisd;

/// The hand of an arm whose two crossing joints turn evenly by 0.4 rad in a second: no screw.
Isometry3d hand(double time) {
  const Isometry3d X_base(AngleAxisd(0.4 * time, Vector3d::UnitZ()));
  const Isometry3d X_elbow(Eigen::Translation3d(0.5, 0.0, 0.0) * AngleAxisd(0.4 * time, Vector3d::UnitY()));
  return X_base * X_elbow * Eigen::Translation3d(0.3, 0.0, 0.0);
}

const PosesAt kHandAndRest = [](double time, std::vector<Isometry3d>& X_WB) {
  X_WB = {hand(time), Isometry3d::Identity()};
};
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
  // The error that is reported is the true one, from both sides.
  const double worst = worstDeviation(motion);
  EXPECT_LE(worst, 1.05 * motion.motion_error[0]);
  EXPECT_GE(worst, 0.3 * motion.motion_error[0]);
}

TEST(SampleMotion, ReportsWhatIsLeftWhenHalvingEnds) {
  CycleMotion motion;
  sampleMotion({0.0, 1.0}, kHandAndRest, kBalls, {1e-6, 0}, motion);
  EXPECT_EQ(motion.times.size(), 2u);
  EXPECT_GT(motion.motion_error[0], 1e-4);
  EXPECT_LE(worstDeviation(motion), 1.05 * motion.motion_error[0]);
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

}  // namespace
}  // namespace sdf_ccd
