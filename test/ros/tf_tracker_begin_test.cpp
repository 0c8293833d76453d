// How the first cycle begins.
#include "ros/tf_tracker_case.h"

namespace sdf_ccd::tf_tracker_begin_test {

using test::stampedTransform;
using test::TfTrackerTest;

TEST_F(TfTrackerTest, AFrameThatNeverCameIsMissingAfterMaxLatency) {
  send(stampedTransform("world", "hand", 10.0, 0.0));
  EXPECT_EQ(next(10.0), Step::kWaiting);
  send(stampedTransform("world", "hand", 10.3, 0.0));
  EXPECT_EQ(next(10.3), Step::kWaiting);
  send(stampedTransform("world", "hand", 10.6, 0.0));
  EXPECT_EQ(next(10.6), Step::kWaiting);  // the first cycle begins here
  send(stampedTransform("world", "hand", 10.7, 0.0));
  ASSERT_EQ(next(10.7), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[1], "no transform from foot to world: no transform of foot was received");
  EXPECT_NEAR(spanStart(1), 10.0, 1e-9);  // what the other pair did while it waited is not lost
  EXPECT_NEAR(spanEnd(1), 10.7, 1e-9);
}

/// The frame that is known first is not the one whose transforms end first.
TEST_F(TfTrackerTest, TheFirstCycleBeginsWithTheEarliestTransform) {
  send(stampedTransform("world", "hand", 10.2, 0.0));
  EXPECT_EQ(next(10.3), Step::kWaiting);
  send(stampedTransform("world", "foot", 10.1, 0.0));
  sendBoth(10.4);
  EXPECT_EQ(next(10.4), Step::kWaiting);
  sendBoth(10.5);
  ASSERT_EQ(next(10.5), Step::kCycle);
  EXPECT_EQ(cycle_.origin, ros::Time(10.1));
  EXPECT_NEAR(spanStart(0), 10.2, 1e-9);
  EXPECT_NEAR(spanStart(2), 10.1, 1e-9);
}

/// At the start no transforms come for 0.6 s, longer than is waited for them; then all do at once.
TEST_F(TfTrackerTest, WhatComesAfterTheFirstCycleHasBegunIsChecked) {
  EXPECT_EQ(next(10.0), Step::kWaiting);
  EXPECT_EQ(next(10.55), Step::kWaiting);  // the first cycle begins here
  ASSERT_EQ(next(10.58), Step::kCycle);
  EXPECT_EQ(cycle_.origin, ros::Time(10.0)) << "the time that was waited for is named";
  for (const int body : {0, 1}) EXPECT_NE(cycle_.motion.missing[body], "");
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanStart(pair), 10.0, 1e-9);
  for (int i = 0; i <= 30; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.02 * i, 0.01 * i));
    send(stampedTransform("world", "foot", 10.1 + 0.017 * i, 0.0));
  }
  ASSERT_EQ(next(10.61), Step::kCycle);
  for (const std::string& why : cycle_.motion.missing) EXPECT_EQ(why, "");
  EXPECT_NEAR(spanStart(0), 10.1, 1e-9);
  EXPECT_NEAR(spanStart(1), 10.0, 1e-9);
  EXPECT_NEAR(spanStart(2), 10.1, 1e-9);
  for (const int pair : {0, 1, 2}) EXPECT_GE(spanEnd(pair), 10.6 - 1e-9);
}

TEST_F(TfTrackerTest, WhatWasKnownBeforeTheLastFrameCameIsChecked) {
  for (int i = 0; i < 8; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.05 * i, 0.01 * i));
    EXPECT_EQ(next(10.0 + 0.05 * i), Step::kWaiting);
  }
  send(stampedTransform("world", "hand", 10.4, 0.1));
  send(stampedTransform("world", "foot", 10.4, 0.0));
  EXPECT_EQ(next(10.4), Step::kWaiting);  // the first cycle begins here
  send(stampedTransform("world", "hand", 10.45, 0.1));
  send(stampedTransform("world", "foot", 10.45, 0.0));
  ASSERT_EQ(next(10.45), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(10.4));
  EXPECT_EQ(cycle_.origin, ros::Time(10.0));
  EXPECT_NEAR(spanStart(0), 10.4, 1e-9);
  EXPECT_NEAR(spanStart(1), 10.0, 1e-9);
  EXPECT_NEAR(spanStart(2), 10.4, 1e-9);
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanEnd(pair), 10.45, 1e-9);
  for (const std::string& why : cycle_.motion.missing) EXPECT_EQ(why, "");
}

/// Transforms that come in a burst, after a gap in the network, are as old as the gap is long.
TEST_F(TfTrackerTest, ChecksWhatIsOlderThanItsFirstLook) {
  for (int i = 0; i <= 40; ++i) {
    sendBoth(10.0 + 0.05 * i);
  }
  EXPECT_EQ(next(12.0), Step::kWaiting);
  sendBoth(12.1);
  ASSERT_EQ(next(12.1), Step::kCycle);
  EXPECT_EQ(cycle_.origin, ros::Time(10.0));
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanStart(pair), 10.0, 1e-9);
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanEnd(pair), 12.1, 1e-9);
  for (const std::string& why : cycle_.motion.missing) EXPECT_EQ(why, "");
}

TEST_F(TfTrackerTest, BeginsWhenTransformsAheadOfTheClockAreKnownAndMakesNobodyLate) {
  ros::Time first_start;
  for (int i = 0; i <= 40; ++i) {
    send(stampedTransform("world", "foot", 10.2 + 0.03 * i, 0.0));      // 0.2 s in the future
    send(stampedTransform("world", "hand", 9.85 + 0.03 * i, 0.1 * i));  // 0.15 s late
    if (next(10.0 + 0.03 * i) != Step::kCycle) continue;
    if (first_start.isZero()) first_start = cycle_.start;
    EXPECT_EQ(cycle_.motion.missing[0], "") << i;
    EXPECT_EQ(cycle_.motion.missing[1], "") << i;
  }
  EXPECT_NEAR(first_start.toSec(), 10.21, 1e-9);
  EXPECT_NEAR(cycle_.end.toSec(), 11.2, 1e-9);  // that of the foot, but not beyond the clock
  EXPECT_NEAR(cycle_.complete_until.toSec(), 11.05, 1e-9);
}

}  // namespace sdf_ccd::tf_tracker_begin_test
