#include <gtest/gtest.h>

#include "ros/tf_history_case.h"

namespace sdf_ccd::tf_history_limits_test {

using namespace test;

TEST(TfHistory, StampsBeyondAllClocksAndEmptyNamesAreRefused) {
  TfHistory history("world");
  geometry_msgs::TransformStamped far = stampedTransform("world", "hand", 1.0, 0.0);
  far.header.stamp = ros::TIME_MAX;
  history.add(message({far, stampedTransform("", "hand", 1.0, 0.0), stampedTransform("world", "", 1.0, 0.0),
                       stampedTransform("hand", "hand", 1.0, 0.0)}),
              false);
  EXPECT_EQ(history.ignored().refused, 4);
  EXPECT_NE(history.span("hand").problem, "");
}

TEST(TfHistory, FramesThatNobodyWantsAreDroppedBeyondAThousand) {
  TfHistory history("world", {{"world", "hand"}, 10.0});
  history.watchClock(ros::Time(100.0));
  for (int i = 0; i < 20000; ++i) {
    history.add(message({stampedTransform("world", "foreign" + std::to_string(i), 100.0, 0.0)}), false);
  }
  EXPECT_EQ(history.ignored().not_kept, 19000);
  history.add(message({stampedTransform("world", "hand", 100.0, 1.0)}), false);
  EXPECT_NEAR(xOf(history, "hand", 100.0), 1.0, 1e-12);
  EXPECT_EQ(problemOf(history, "foreign3", 100.0), "");
  history.watchClock(ros::Time(120.0));  // they have fallen silent
  history.add(message({stampedTransform("world", "camera", 120.0, 2.0)}), false);
  EXPECT_NEAR(xOf(history, "camera", 120.0), 2.0, 1e-12);
  EXPECT_NE(problemOf(history, "foreign3", 100.0), "");
}

TEST(TfHistory, WhatIsAboveAWantedFrameIsFollowedInWhateverOrderItComes) {
  TfHistory history("map", {{"map", "hand"}, 10.0});
  history.add(message({stampedTransform("map", "odom", 0.0, 1.0)}), true);
  for (int i = 0; i < 20000; ++i) {
    history.add(message({stampedTransform("map", "foreign" + std::to_string(i), 100.0, 0.0)}), false);
  }
  for (const double stamp : {100.0, 100.1}) {
    history.add(message({stampedTransform("base", "hand", stamp, 3.0), stampedTransform("odom", "base", stamp, 2.0)}),
                false);
  }
  EXPECT_NEAR(xOf(history, "hand", 100.1), 6.0, 1e-12);
}

TEST(TfHistory, SaysWhenAStaticFrameMayBeNeededThatHadNoRoom) {
  TfHistory history("map", {{"map", "hand"}, 10.0});
  history.add(message({stampedTransform("map", "hand", 100.0, 3.0)}), false);
  for (int i = 0; i < 6000; ++i) {
    history.add(message({stampedTransform("map", "foreign" + std::to_string(i), 0.0, 0.0)}), true);
  }
  const geometry_msgs::TransformStamped tool = stampedTransform("map", "tool", 0.0, 1.0);
  history.add(message({tool}), true);
  EXPECT_FALSE(history.takeMissedStatic());  // no followed frame needs it
  history.add(message({stampedTransform("tool", "hand", 101.0, 2.0)}), false);
  EXPECT_NE(problemOf(history, "hand", 101.0), "");
  EXPECT_TRUE(history.takeMissedStatic());
  EXPECT_FALSE(history.takeMissedStatic());
  history.add(message({tool}), true);  // it is sent again to a new subscriber
  EXPECT_NEAR(xOf(history, "hand", 101.0), 3.0, 1e-12);
}

TEST(TfHistory, PublishersThatDisagreeAboutParentsLeaveNothingBehind) {
  TfHistory history("world", {{"world", "hand"}, 10.0});
  for (int i = 0; i < 20000; ++i) {
    const double stamp = 100.0 + 1e-3 * i;
    const std::string other = "elsewhere" + std::to_string(i);
    history.add(message({stampedTransform("world", other, stamp, 0.0), stampedTransform(other, "hand", stamp, 0.0)}),
                false);
  }
  EXPECT_GT(history.ignored().not_kept, 15000);
  history.add(message({stampedTransform("world", "hand", 120.0, 1.0), stampedTransform("world", "hand", 120.1, 1.0)}),
              false);
  EXPECT_NEAR(xOf(history, "hand", 120.1), 1.0, 1e-12);
}

TEST(TfHistory, FramesThatBecomeStaticAreBoundedToo) {
  TfHistory history("world", {{"world", "hand"}, 10.0});
  history.watchClock(ros::Time(100.0));
  for (int i = 0; i < 20000; ++i) {
    const tf2_msgs::TFMessage frame = message({stampedTransform("world", "foreign" + std::to_string(i), 100.0, 0.0)});
    history.add(frame, false);
    history.add(frame, true);
  }
  EXPECT_GT(history.ignored().not_kept, 14000);
}

TEST(TfHistory, StaticFramesThatABodyHasHungOnAreForgottenWhenThereAreTooMany) {
  TfHistory history("world", {{"world", "hand"}, 10.0});
  history.watchClock(ros::Time(100.0));
  for (int i = 0; i < 12000; ++i) {
    const double stamp = 100.0 + 1e-4 * i;
    const std::string parent = "parent" + std::to_string(i);
    history.add(message({stampedTransform(parent, "hand", stamp, 1.0)}), false);
    history.add(message({stampedTransform("world", parent, 0.0, 1.0)}), true);
  }
  EXPECT_EQ(problemOf(history, "parent3", 101.0), "");
  history.watchClock(ros::Time(113.0));
  EXPECT_NE(problemOf(history, "parent3", 101.0), "");
  history.add(message({stampedTransform("parent11999", "hand", 113.0, 1.0)}), false);
  EXPECT_NEAR(xOf(history, "hand", 113.0), 2.0, 1e-12) << "what the body hangs on now";
}

TEST(TfHistory, RecordsAreBoundedHoweverFastTheyCome) {
  TfHistory history("world");
  for (int i = 0; i < 60000; ++i) {
    history.add(message({stampedTransform("world", "hand", 100.0 + 1e-4 * i, 1e-3 * i)}), false);
  }
  EXPECT_LE(recordedTimes(history, "hand", 100.0, 106.0).size(), 20000u);
  EXPECT_NE(problemOf(history, "hand", 101.0), "");  // dropped, and so not known
  EXPECT_EQ(problemOf(history, "hand", 105.9), "");
}

TEST(TfHistory, WhatComesFarBehindManyOthersEndsWhatIsKnownBeforeIt) {
  TfHistory history("world");
  for (int i = 0; i < 5000; ++i) {
    history.add(message({stampedTransform("world", "hand", 100.0 + 2e-4 * i, 1e-3 * i)}), false);
  }
  history.add(message({stampedTransform("world", "hand", 100.2001, 50.0)}), false);
  EXPECT_NE(problemOf(history, "hand", 100.2), "");
  EXPECT_EQ(problemOf(history, "hand", 100.3), "");
  EXPECT_EQ(takeSpans(history, {"hand"})[0].late.size(), 1u);
}

TEST(TfHistory, StampsFarAheadOfTheClockAndLongNamesAreRefused) {
  TfHistory history("world");
  history.watchClock(ros::Time(100.0));
  history.add(message({stampedTransform("world", "hand", 100.0, 1.0), stampedTransform("world", "hand", 105.0, 1.0),
                       stampedTransform("world", "hand", 110.1, 1.0)}),
              false);
  EXPECT_EQ(history.ignored().refused, 1);
  EXPECT_EQ(history.ignored().refusal, "hand is stamped 110.100 s, when it is 100.000 s");
  history.add(message({stampedTransform("world", std::string(1000000, 'x'), 100.0, 1.0)}), false);
  EXPECT_EQ(history.ignored().refusal, "a frame's name has 1000000 characters");
  geometry_msgs::TransformStamped last = stampedTransform("world", "fixed", 0.0, 1.0);
  last.header.stamp.sec = last.header.stamp.nsec = std::numeric_limits<std::uint32_t>::max();
  EXPECT_NO_THROW(history.add(message({last}), true));
  EXPECT_NO_THROW(history.add(message({last}), false));
  EXPECT_NEAR(xOf(history, "fixed", 100.0), 1.0, 1e-12);
}

}  // namespace sdf_ccd::tf_history_limits_test
