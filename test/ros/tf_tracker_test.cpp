#include "ros/tf_tracker_case.h"

#include <cmath>
#include <limits>

namespace sdf_ccd::tf_tracker_test {

using test::stampedTransform;
using test::TfTrackerTest;
using Step = TfTracker::Step;

TEST_F(TfTrackerTest, PairsGoAsFarAsBothFramesAreKnownAndHoldEveryRecordedTransform) {
  send(stampedTransform("/world", "/hand", 10.0, 0.0));
  send(stampedTransform("world", "foot", 10.0, 0.0));
  EXPECT_EQ(next(10.0), Step::kWaiting);  // the first cycle begins
  send(stampedTransform("world", "hand", 10.02, 0.1));
  send(stampedTransform("world", "hand", 10.05, 0.4));
  send(stampedTransform("world", "hand", 10.09, 0.5));
  send(stampedTransform("world", "foot", 10.03, 1.0));
  send(stampedTransform("world", "foot", 10.07, 2.0));
  ASSERT_EQ(next(10.1), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(10.0));
  EXPECT_EQ(cycle_.origin, ros::Time(10.0));
  EXPECT_EQ(cycle_.end, ros::Time(10.09));
  EXPECT_EQ(cycle_.complete_until, ros::Time(10.07));
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanStart(pair), 10.0, 1e-9);
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanEnd(pair), pair == 1 ? 10.09 : 10.07, 1e-9);
  ASSERT_EQ(cycle_.samples.size(), 6u);
  EXPECT_NEAR(cycle_.samples[1], 0.02, 1e-9);
  EXPECT_NEAR(cycle_.samples[2], 0.03, 1e-9);
  EXPECT_NEAR(cycle_.samples[3], 0.05, 1e-9);
  ASSERT_EQ(cycle_.motion.times, cycle_.samples);
  EXPECT_NEAR(cycle_.motion.X_WB[0][1].translation().x(), 0.1, 1e-9);
  EXPECT_NEAR(cycle_.motion.X_WB[0][2].translation().x(), 0.2, 1e-9);  // as tf2 interpolates
  EXPECT_NEAR(cycle_.motion.X_WB[1][2].translation().x(), 1.0, 1e-9);
  EXPECT_NEAR(cycle_.motion.X_WB[1].back().translation().x(), 2.0, 1e-9);
  for (const std::string& missing : cycle_.motion.missing) EXPECT_EQ(missing, "");
  EXPECT_EQ(next(10.1), Step::kWaiting);
}

TEST_F(TfTrackerTest, GapsAddUpWhereStampsDiffer) {
  const auto send = [&](const char* parent, const char* child, double stamp) {
    TfTrackerTest::send(stampedTransform(parent, child, stamp, stamp));
  };
  for (const double stamp : {10.0, 10.1}) {
    send("world", "base", stamp);
    send("base", "hand", stamp);
    send("world", "foot", stamp);
    next(stamp);
  }
  ASSERT_EQ(cycle_.gaps.size(), 3u);
  EXPECT_NEAR(cycle_.gaps[0], 0.1, 1e-9);
  EXPECT_NEAR(cycle_.gaps[1], 0.1, 1e-9);
  EXPECT_EQ(cycle_.gaps[2], 0.0);
  send("world", "base", 10.2);
  send("base", "hand", 10.15);
  send("base", "hand", 10.25);
  send("world", "foot", 10.2);
  ASSERT_EQ(next(10.25), Step::kCycle);
  EXPECT_NEAR(cycle_.gaps[0], 0.2, 1e-9);
  EXPECT_NEAR(cycle_.gaps[1], 0.1, 1e-9);
}

TEST_F(TfTrackerTest, AFrameThatJumpsIsMissingForTheCycle) {
  const auto step = [&](double stamp, double hand, double foot) {
    send(stampedTransform("world", "hand", stamp, hand));
    send(stampedTransform("world", "foot", stamp, foot));
    return next(stamp);
  };
  step(10.0, 0.0, 0.0);
  ASSERT_EQ(step(10.1, 90.0, 500.0), Step::kCycle);  // foot: 5000 m/s
  EXPECT_EQ(cycle_.motion.missing[0], "");
  EXPECT_EQ(cycle_.motion.missing[1], "foot has jumped by 500 m");
  ASSERT_EQ(step(10.2, 181.0, 501.0), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[0], "");
  EXPECT_EQ(cycle_.motion.missing[1], "");
  ASSERT_EQ(step(10.9, 700.0, 4000000.0), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[0], "");  // it could be a jet
  EXPECT_EQ(cycle_.motion.missing[1], "foot has jumped by 3999499 m");
}

TEST_F(TfTrackerTest, AFrameBeyondAllNumbersIsMissing) {
  for (const double stamp : {10.0, 10.1}) {
    send(stampedTransform("world", "hand", stamp, stamp > 10.05 ? 1e300 : 0.0));
    send(stampedTransform("world", "foot", stamp, stamp > 10.05 ? std::numeric_limits<double>::infinity() : 0.0));
    ASSERT_EQ(next(stamp), stamp > 10.05 ? Step::kCycle : Step::kWaiting);
  }
  EXPECT_EQ(cycle_.motion.missing[0], "hand is more than 1e+08 m from its parent");
  EXPECT_EQ(cycle_.motion.missing[1], "foot has a transform that is not finite");
  EXPECT_EQ(cycle_.motion.missing[2], "");
}

/// A ros::Duration holds no more than 2^31 s.
TEST_F(TfTrackerTest, AClockThatIsSetFartherAheadThanADurationHoldsIsSurvived) {
  constexpr double kAhead = 4294967000.0;
  const auto lastStep = [&](double time) {
    for (const double stamp : {time, time + 0.1}) {
      for (const char* link : {"hand", "foot"}) send(stampedTransform("world", link, stamp, 0.0));
      if (next(stamp) == Step::kCycle) return Step::kCycle;
    }
    return Step::kWaiting;
  };
  EXPECT_EQ(lastStep(100.0), Step::kCycle);
  EXPECT_EQ(next(kAhead), Step::kStalled);
  send(stampedTransform("world", "hand", 101.0, 0.0));
  EXPECT_EQ(next(kAhead + 1.0), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[1], "foot is late by 0.90 s");
  EXPECT_EQ(next(200.0), Step::kJump);
  EXPECT_EQ(lastStep(201.0), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[0], "");
}

TEST_F(TfTrackerTest, WhereNothingMovesAClockThatIsSetFarAheadBeginsAnew) {
  for (const char* link : {"hand", "foot"}) send(stampedTransform("world", link, 0.0, 0.0), true);
  for (const double begin : {100.0, 4294967000.0, 100.0}) {
    if (!cycle_.end.isZero()) {
      EXPECT_EQ(next(begin), Step::kJump);
    }
    EXPECT_EQ(next(begin + 0.1), Step::kWaiting);
    EXPECT_EQ(next(begin + 0.2), Step::kCycle);
    EXPECT_EQ(cycle_.motion.missing[0], "");
  }
}

TEST_F(TfTrackerTest, RestingFramesAddNoTimes) {
  for (int i = 0; i <= 10; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.01 * i, i == 5 ? 0.3 : 0.0));
    send(stampedTransform("world", "foot", 10.0 + 0.01 * i, 0.0));
    if (i == 0) {
      EXPECT_EQ(next(10.0), Step::kWaiting);
    }
  }
  ASSERT_EQ(next(10.1), Step::kCycle);
  ASSERT_EQ(cycle_.samples.size(), 5u);  // both ends, and before, at and after the move
  EXPECT_NEAR(cycle_.samples[1], 0.04, 1e-9);
  EXPECT_NEAR(cycle_.samples[3], 0.06, 1e-9);
  EXPECT_EQ(cycle_.recorded.size(), 11u);
}

TEST_F(TfTrackerTest, TheEndOfACycleIsNoRecordedTransform) {
  for (const double stamp : {10.0, 10.05, 10.2})
    for (const char* frame : {"hand", "foot"}) send(stampedTransform("world", frame, stamp, stamp - 10.0));
  EXPECT_EQ(next(10.0), Step::kWaiting);
  ASSERT_EQ(next(10.1), Step::kCycle);
  EXPECT_EQ(cycle_.end, ros::Time(10.1));
  ASSERT_EQ(cycle_.samples.size(), 3u);
  ASSERT_EQ(cycle_.recorded.size(), 2u);
  EXPECT_NEAR(cycle_.recorded[0], 0.0, 1e-9);
  EXPECT_NEAR(cycle_.recorded[1], 0.05, 1e-9);
  ASSERT_EQ(next(10.2), Step::kCycle);
  ASSERT_EQ(cycle_.recorded.size(), 1u);
  EXPECT_NEAR(cycle_.recorded[0], 0.1, 1e-9);
}

TEST_F(TfTrackerTest, ALateFrameDelaysOnlyItsOwnPairsAndIsCaughtUpOn) {
  for (int i = 0; i <= 3; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.1 * i, 0.1 * i));
    if (i <= 1) send(stampedTransform("world", "foot", 10.0 + 0.1 * i, 0.0));
    ASSERT_EQ(next(10.0 + 0.1 * i), i == 0 ? Step::kWaiting : Step::kCycle);
    if (i < 2) continue;
    EXPECT_NEAR(cycle_.complete_until.toSec(), 10.1, 1e-9);
    EXPECT_TRUE(cycle_.motion.spans[0].empty());
    EXPECT_NEAR(spanStart(1), 10.0 + 0.1 * (i - 1), 1e-9);
    EXPECT_NEAR(spanEnd(1), 10.0 + 0.1 * i, 1e-9);
    EXPECT_TRUE(cycle_.motion.spans[2].empty());
  }
  send(stampedTransform("world", "foot", 10.25, 1.5));
  send(stampedTransform("world", "hand", 10.4, 0.4));
  ASSERT_EQ(next(10.4), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(10.3));
  EXPECT_EQ(cycle_.end, ros::Time(10.4));
  EXPECT_EQ(cycle_.origin, ros::Time(10.1));
  EXPECT_EQ(cycle_.complete_until, ros::Time(10.25));
  for (const int pair : {0, 2}) {
    EXPECT_NEAR(spanStart(pair), 10.1, 1e-9);
    EXPECT_NEAR(spanEnd(pair), 10.25, 1e-9);
  }
  EXPECT_NEAR(spanStart(1), 10.3, 1e-9);
  EXPECT_NEAR(spanEnd(1), 10.4, 1e-9);
  ASSERT_EQ(cycle_.samples.size(), 5u);  // 10.1, 10.2 (of the hand), 10.25, 10.3, 10.4
  EXPECT_NEAR(cycle_.motion.X_WB[0][1].translation().x(), 0.2, 1e-9);
  EXPECT_NEAR(cycle_.motion.X_WB[1][1].translation().x(), 1.0, 1e-9);
  for (const std::string& missing : cycle_.motion.missing) EXPECT_EQ(missing, "");
}

TEST_F(TfTrackerTest, PairsThatGoOnTogetherHaveNoSpans) {
  sendBoth(10.0);
  ASSERT_EQ(next(10.0), Step::kWaiting);
  sendBoth(10.1);
  ASSERT_EQ(next(10.1), Step::kCycle);
  EXPECT_TRUE(cycle_.motion.spans.empty());
  EXPECT_GE(cycle_.motion.spans.capacity(), 3u) << "they may need some in a later cycle, which must not allocate";
}

TEST_F(TfTrackerTest, PairsThatAreBehindGoOnWhereNothingElseComes) {
  for (int i = 0; i <= 3; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.1 * i, 0.1 * i));
    if (i <= 1) send(stampedTransform("world", "foot", 10.0 + 0.1 * i, 0.0));
    ASSERT_EQ(next(10.0 + 0.1 * i), i == 0 ? Step::kWaiting : Step::kCycle);
  }
  EXPECT_EQ(next(10.31), Step::kWaiting);
  send(stampedTransform("world", "foot", 10.25, 1.5));
  ASSERT_EQ(next(10.32), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(10.3));
  EXPECT_EQ(cycle_.end, ros::Time(10.3));
  EXPECT_EQ(cycle_.complete_until, ros::Time(10.25));
  EXPECT_TRUE(cycle_.delayed_since.isZero());
  for (const int pair : {0, 2}) {
    EXPECT_NEAR(spanStart(pair), 10.1, 1e-9);
    EXPECT_NEAR(spanEnd(pair), 10.25, 1e-9);
  }
  EXPECT_TRUE(cycle_.motion.spans[1].empty());
  EXPECT_EQ(cycle_.motion.spans[1].last, cycle_.motion.times.size() - 1);
  EXPECT_EQ(next(10.33), Step::kWaiting);
  send(stampedTransform("world", "foot", 10.35, 1.5));
  ASSERT_EQ(next(10.36), Step::kCycle);
  EXPECT_EQ(cycle_.end, ros::Time(10.35));
  EXPECT_NEAR(spanEnd(0), 10.3, 1e-9);
  EXPECT_NEAR(spanEnd(2), 10.35, 1e-9);
}

TEST_F(TfTrackerTest, AFrameThatStaysAwayIsMissingAlsoWhereNothingElseComes) {
  for (int i = 0; i <= 5; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.1 * i, 0.01 * i));
    if (i <= 1) send(stampedTransform("world", "foot", 10.0 + 0.1 * i, 0.0));
    EXPECT_EQ(next(10.0 + 0.1 * i), i == 0 ? Step::kWaiting : Step::kCycle) << i;
  }
  ros::Time::init();  // otherwise frames are late only beside newer ones
  ASSERT_FALSE(ros::Time::isSimTime());
  ASSERT_EQ(next(10.7), Step::kCycle);
  EXPECT_EQ(cycle_.end, ros::Time(10.5));
  EXPECT_EQ(cycle_.motion.missing[1], "foot is late by 0.60 s");
  EXPECT_NEAR(spanStart(0), 10.1, 1e-9);
  EXPECT_NEAR(spanEnd(0), 10.5, 1e-9);
  EXPECT_EQ(cycle_.complete_until, ros::Time(10.5));
  EXPECT_EQ(next(10.75), Step::kWaiting);
  ros::Time::setNow(ros::Time());
}

TEST_F(TfTrackerTest, AFrameThatStaysAwayIsMissingAfterMaxLatency) {
  for (int i = 0; i <= 5; ++i) {
    send(stampedTransform("world", "hand", 10.0 + 0.1 * i, 0.01 * i));
    if (i <= 1) send(stampedTransform("world", "foot", 10.0 + 0.1 * i, 0.0));
    EXPECT_EQ(next(10.0 + 0.1 * i), i == 0 ? Step::kWaiting : Step::kCycle) << i;
  }
  send(stampedTransform("world", "hand", 10.7, 0.07));
  ASSERT_EQ(next(10.7), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(10.5));
  EXPECT_EQ(cycle_.end, ros::Time(10.7));
  EXPECT_EQ(cycle_.complete_until, ros::Time(10.7));
  EXPECT_NEAR(spanStart(0), 10.1, 1e-9);  // the time that is not checked
  EXPECT_NEAR(spanEnd(0), 10.7, 1e-9);
  EXPECT_EQ(cycle_.motion.missing[0], "");
  EXPECT_EQ(cycle_.motion.missing[1], "foot is late by 0.60 s");
  // It comes back: the first cycle that it covers from the start is checked.
  send(stampedTransform("world", "foot", 10.75, 0.0));
  send(stampedTransform("world", "hand", 10.75, 0.08));
  ASSERT_EQ(next(10.75), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[1], "");
}

TEST_F(TfTrackerTest, WhereTimeIsNotSimulatedAllFramesMayBeTooOld) {
  const auto verdicts = [&](double start) {
    std::string said;
    for (int i = 0; i <= 30; ++i) {
      for (const char* frame : {"hand", "foot"})
        send(stampedTransform("world", frame, start + 0.03 * i - 2.0, 0.01 * i));
      if (next(start + 0.03 * i) == Step::kCycle) said = cycle_.motion.missing[0];
    }
    return said;
  };
  EXPECT_EQ(verdicts(100.0), "");  // a bag that is played later than its clock
  ros::Time::init();
  ASSERT_FALSE(ros::Time::isSimTime());
  EXPECT_EQ(verdicts(200.0), "hand is late by 2.00 s");
  for (int i = 0; i <= 3; ++i) {
    for (const char* frame : {"hand", "foot"}) send(stampedTransform("world", frame, 201.0 + 0.03 * i, 0.0));
    next(201.01 + 0.03 * i);
  }
  EXPECT_EQ(cycle_.motion.missing[0], "");
  EXPECT_EQ(next(203.0), Step::kStalled);
  ros::Time::setNow(ros::Time());
  ASSERT_TRUE(ros::Time::isSimTime());
}

/// A transform that is stamped far back may only be late; the second one tells, and both count.
TEST_F(TfTrackerTest, AfterAJumpNothingIsLostOfTheNewTime) {
  for (const double time : {10.0, 10.1, 10.2}) {
    sendBoth(time);
    next(time);
  }
  sendBoth(5.0);
  EXPECT_EQ(next(10.3), Step::kWaiting);
  sendBoth(5.1);
  EXPECT_EQ(next(10.4), Step::kJump);
  sendBoth(5.2);
  next(10.5);
  sendBoth(5.3);
  ASSERT_EQ(next(10.6), Step::kCycle);
  for (const int pair : {0, 1, 2}) EXPECT_NEAR(spanStart(pair), 5.0, 1e-9) << pair;
  EXPECT_NEAR(spanEnd(0), 5.3, 1e-9);
}

TEST_F(TfTrackerTest, AGapIsMissingAndALongPauseToo) {
  sendBoth(10.0);
  EXPECT_EQ(next(10.0), Step::kWaiting);
  EXPECT_EQ(next(10.6), Step::kStalled);
  send(stampedTransform("world", "hand", 13.0, 1.0));
  send(stampedTransform("world", "foot", 13.0, 0.0));
  ASSERT_EQ(next(13.0), Step::kCycle);
  EXPECT_EQ(cycle_.motion.missing[0], "no cycle for 3.00 s, longer than max_cycle (1.00 s)");
  EXPECT_EQ(cycle_.motion.missing[1], "no cycle for 3.00 s, longer than max_cycle (1.00 s)");
  EXPECT_EQ(cycle_.motion.missing[2], "");  // does not move
  send(stampedTransform("world", "hand", 13.03, 1.0));
  send(stampedTransform("world", "foot", 13.03, 0.0));
  ASSERT_EQ(next(13.03), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(13.0));
  EXPECT_EQ(cycle_.motion.missing[0], "");
}

TEST_F(TfTrackerTest, TimeThatJumpsBackStartsAnewButKeepsStaticFrames) {
  send(stampedTransform("world", "foot", 0.0, 0.5), true);
  send(stampedTransform("world", "hand", 100.0, 0.0));
  EXPECT_EQ(next(100.0), Step::kWaiting);
  send(stampedTransform("world", "hand", 100.03, 0.0));
  EXPECT_EQ(next(100.03), Step::kCycle);
  send(stampedTransform("world", "hand", 50.0, 2.0));
  EXPECT_EQ(next(100.06), Step::kWaiting);  // one old transform counts as late
  send(stampedTransform("world", "hand", 50.03, 2.5));
  EXPECT_EQ(next(100.09), Step::kJump);
  EXPECT_EQ(next(100.09), Step::kWaiting);
  send(stampedTransform("world", "hand", 50.06, 3.0));
  ASSERT_EQ(next(100.12), Step::kCycle);
  EXPECT_EQ(cycle_.start, ros::Time(50.03));
  EXPECT_EQ(cycle_.end, ros::Time(50.06));
  EXPECT_EQ(cycle_.motion.missing[1], "");
  EXPECT_NEAR(cycle_.motion.X_WB[1][0].translation().x(), 0.5, 1e-9);
}

TEST_F(TfTrackerTest, AClockThatGoesBackStartsAnew) {
  sendBoth(100.0);
  EXPECT_EQ(next(100.0), Step::kWaiting);
  EXPECT_EQ(next(20.0), Step::kJump);
  EXPECT_EQ(next(20.03), Step::kWaiting);
}

TEST_F(TfTrackerTest, CurvedMotionGetsMoreSamplesAndAnError) {
  // The hand rotates about the foot, which translates: both at constant rates in tf2, which together are no screw.
  send(stampedTransform("world", "foot", 10.0, 0.0));
  send(stampedTransform("foot", "hand", 10.0, 0.0));
  EXPECT_EQ(next(10.0), Step::kWaiting);
  send(stampedTransform("world", "foot", 10.1, 0.3));
  send(stampedTransform("foot", "hand", 10.1, 0.0, 0.5));
  ASSERT_EQ(next(10.1), Step::kCycle);
  EXPECT_EQ(cycle_.samples.size(), 2u);
  EXPECT_GT(cycle_.motion.times.size(), 4u);
  EXPECT_GT(cycle_.motion.motion_error[0], 0.0);
  EXPECT_LE(cycle_.motion.motion_error[0], 1e-4);
  EXPECT_EQ(cycle_.motion.motion_error[2], 0.0);
}

TEST(TfTracker, TilesOfAMapDoNotLimitTheRateOfTransforms) {
  constexpr int kTiles = 3000, kSamples = 1000;
  TfHistory history("world");
  std::vector<TrackedBody> bodies(kTiles, {"map", Isometry3d(Eigen::Translation3d(0.0, 2.0, 0.0)), {}});
  bodies.push_back({"hand", Isometry3d::Identity(), {Vector3d::Zero(), 0.1}});
  std::vector<PlannedPair> pairs;
  for (int tile = 0; tile < kTiles; ++tile) pairs.push_back({tile, kTiles, true, true});
  TfTracker tracker(history, bodies, pairs, TfTrackerOptions());
  TrackedCycle cycle;
  history.add(test::message({stampedTransform("world", "map", 0.0, 1.0)}), true);
  history.add(test::message({stampedTransform("world", "hand", 10.0, 0.0)}), false);
  EXPECT_EQ(tracker.next(ros::Time(10.0), cycle), Step::kWaiting);
  for (int i = 1; i <= kSamples; ++i)
    history.add(test::message({stampedTransform("world", "hand", 10.0 + 1e-3 * i, 1e-6 * i * i)}), false);
  ASSERT_EQ(tracker.next(ros::Time(11.0), cycle), Step::kCycle);
  for (const std::string& missing : cycle.motion.missing) ASSERT_EQ(missing, "");
  EXPECT_EQ(cycle.motion.times.size(), kSamples + 1u);
  EXPECT_EQ(cycle.motion.X_WB[kTiles].size(), kSamples + 1u);
  EXPECT_NEAR(cycle.motion.pose(kTiles, 30).translation().x(), 9e-4, 1e-9);
  ASSERT_EQ(cycle.motion.X_WB[0].size(), 1u);
  EXPECT_EQ(cycle.motion.pose(0, 30).translation(), Vector3d(1.0, 2.0, 0.0));
}

}  // namespace sdf_ccd::tf_tracker_test
