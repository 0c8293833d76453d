#include "motion/validate_motion.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "oracle/failure.h"

namespace sdf_ccd::validate_motion_test {

CycleMotion motionOfTwo() {
  CycleMotion motion;
  motion.times = {0.0, 0.5, 1.0};
  motion.X_WB.assign(2, std::vector<Isometry3d>(3, Isometry3d::Identity()));
  return motion;
}

MotionShape shapeOfTwo() {
  MotionShape shape;
  shape.bodies = {"arm", "table"};
  shape.pairs = 1;
  return shape;
}

/// Why a motion is refused; empty if it is not.
std::string refusal(const CycleMotion& motion, const MotionShape& shape = shapeOfTwo()) {
  return test::failureOf<std::invalid_argument>([&] { validate(motion, shape, "motion"); });
}

TEST(ValidateMotion, TakesWhatFits) {
  CycleMotion motion = motionOfTwo();
  EXPECT_EQ(refusal(motion), "");
  motion.X_WB[1].resize(1);  // at rest
  EXPECT_EQ(refusal(motion), "");
  motion.spans = {{1, 2}};
  motion.motion_error = {0.0, std::numeric_limits<double>::infinity()};
  motion.missing = {"", "lost"};
  motion.X_WB[1].clear();  // of what is missing nothing is read
  EXPECT_EQ(refusal(motion), "");
  MotionShape shape = shapeOfTwo();
  shape.without_poses = {false, true};
  motion.missing.clear();
  EXPECT_EQ(refusal(motion, shape), "");
}

TEST(ValidateMotion, SaysWhatDoesNotFit) {
  CycleMotion motion = motionOfTwo();
  motion.times = {0.0};
  EXPECT_EQ(refusal(motion), "motion: 1 times, two or more are needed");
  motion.times = {0.25, 0.5, 1.0};
  EXPECT_EQ(refusal(motion), "motion: starts at 0.25 s, not 0");
  motion.times = {0.0, 0.5, 0.5};
  EXPECT_EQ(refusal(motion), "motion: times must be finite and increasing: 0.5 s is followed by 0.5 s");
  motion.times = {0.0, 0.5, std::numeric_limits<double>::infinity()};
  EXPECT_EQ(refusal(motion), "motion: times must be finite and increasing: 0.5 s is followed by inf s");
  motion = motionOfTwo();
  motion.spans = {{0, 3}};
  EXPECT_EQ(refusal(motion), "motion: span [0, 3] is not within the 3 times");
  motion.spans = {{0, 1}, {0, 1}};
  EXPECT_EQ(refusal(motion), "motion: 2 spans, the scene has 1 pairs");
  motion = motionOfTwo();
  motion.X_WB[1].pop_back();
  EXPECT_EQ(refusal(motion), "motion: table has 2 poses at 3 times");
  motion.X_WB.pop_back();
  EXPECT_EQ(refusal(motion), "motion: made for 1 bodies, the scene has 2");
  motion = motionOfTwo();
  motion.missing = {""};
  EXPECT_EQ(refusal(motion), "motion: lists missing poses for 1 bodies, the scene has 2");
  motion = motionOfTwo();
  motion.motion_error = {0.0, 0.0, 0.0};
  EXPECT_EQ(refusal(motion), "motion: has motion errors of 3 bodies, the scene has 2");
  motion.motion_error = {0.0, -1.0};
  EXPECT_EQ(refusal(motion), "motion: motion error of table is -1");
  motion.motion_error = {std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_NE(refusal(motion), "");
}

}  // namespace sdf_ccd::validate_motion_test
