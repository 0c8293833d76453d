#include "ros/tf/tf_history.h"

#include <gtest/gtest.h>
#include <tf2/buffer_core.h>

#include <limits>
#include <random>

#include "ros/tf_history_case.h"

namespace sdf_ccd::tf_history_test {

using namespace test;

constexpr const char* kFrames[] = {"base", "left", "left_hand", "right", "right_hand", "tool"};
constexpr const char* kParents[] = {"world", "base", "left", "base", "right", "right_hand"};

TEST(TfHistory, InterpolatesAsTf2Does) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int history_number = 0; history_number < 40; ++history_number) {
    TfHistory history("left_hand");
    tf2::BufferCore buffer;
    const double step = history_number % 2 == 0 ? 1.0 : 0.05;  // large and small rotations
    for (int frame = 0; frame < 6; ++frame) {
      Quaterniond rotation = Quaterniond::UnitRandom();
      double time = 100.0;
      while (time < 102.0) {
        const Quaterniond turn(1.0, step * normal(random), step * normal(random), step * normal(random));
        rotation = (rotation * turn).normalized();
        if (uniform(random) < 0.5) rotation.coeffs() *= -1.0;  // the same rotation
        const Vector3d translation(normal(random), normal(random), normal(random));
        const auto sent = stampedTransform(kParents[frame], kFrames[frame], ros::Time(time), rotation, translation);
        history.add(message({sent}), false);
        buffer.setTransform(sent, "test");
        time += 0.3 * uniform(random);
      }
    }
    for (int sample = 0; sample < 50; ++sample) {
      const ros::Time time(100.3 + 1.3 * uniform(random));
      for (const char* frame : kFrames) {
        Isometry3d X_WF;
        std::string problem;
        ASSERT_TRUE(history.lookup(frame, time, X_WF, problem)) << problem;
        const auto expected = buffer.lookupTransform("left_hand", frame, time).transform;
        EXPECT_LT((X_WF.matrix() - toTfPose({}, expected).isometry().matrix()).cwiseAbs().maxCoeff(), 1e-12);
      }
    }
  }
}

TEST(TfHistory, LatestIsTheNewestThatAllEdgesKnow) {
  TfHistory history("world");
  history.add(message({stampedTransform("world", "base", 10.0, 0.0), stampedTransform("world", "base", 11.0, 1.0),
                       stampedTransform("base", "left", 10.0, 0.0), stampedTransform("base", "left", 10.5, 0.0)}),
              false);
  EXPECT_NEAR(xOf(history, "left", 0.0), 0.5, 1e-12);
  EXPECT_NEAR(xOf(history, "base", 0.0), 1.0, 1e-12);
}

TEST(TfHistory, CountsTransformsOutOfOrderAndIgnoresRepeatedOnes) {
  TfHistory history("world");
  history.add(message({stampedTransform("world", "hand", 1.0, 0.0), stampedTransform("world", "hand", 1.2, 0.0),
                       stampedTransform("world", "hand", 1.2, 5.0), stampedTransform("world", "hand", 1.1, 0.1)}),
              false);
  EXPECT_EQ(history.ignored().out_of_order, 1);
  ASSERT_EQ(recordedTimes(history, "hand", 1.0, 1.2).size(), 1u);
  EXPECT_NEAR(recordedTimes(history, "hand", 1.0, 1.2)[0], 0.1, 1e-12);
  EXPECT_NEAR(xOf(history, "hand", 1.2), 0.0, 1e-12);
}

TEST(TfHistory, TellsOnceWhatCameBehindNewerTransforms) {
  TfHistory history("world");
  for (const double stamp : {1.0, 1.1, 1.2, 1.3}) {
    history.add(
        message({stampedTransform("world", "base", stamp, 0.0), stampedTransform("base", "hand", stamp, stamp)}),
        false);
  }
  history.add(message({stampedTransform("base", "hand", 1.15, 7.0)}), false);
  history.add(message({stampedTransform("world", "base", 1.25, 0.0)}), false);  // it rests, so nothing was wrong
  const std::vector<TfSpan> spans = takeSpans(history, {"base", "hand"});
  EXPECT_TRUE(spans[0].late.empty());
  ASSERT_EQ(spans[1].late.size(), 1u);
  EXPECT_EQ(spans[1].late[0].frame, "hand");
  EXPECT_EQ(spans[1].late[0].since, ros::Time(1.1));
  EXPECT_EQ(spans[1].late[0].until, ros::Time(1.2));
  EXPECT_TRUE(takeSpans(history, {"hand"})[0].late.empty());
  EXPECT_NEAR(xOf(history, "hand", 1.15), 7.0, 1e-12);
}

TEST(TfHistory, GoesUpAndDownTheTree) {
  TfHistory history("left");
  history.add(message({stampedTransform("base", "left", 1.0, 1.0), stampedTransform("base", "right", 1.0, -2.0),
                       stampedTransform("map", "base", 5.0, 0.0)}),
              false);
  const TfSpan span = history.span("right");
  EXPECT_EQ(span.problem, "");
  EXPECT_EQ(span.last, ros::Time(1.0));  // map → base is not in the chain
  EXPECT_NEAR(xOf(history, "right", 1.0), -3.0, 1e-9);
  EXPECT_NE(problemOf(history, "right", 2.0), "");
  EXPECT_NE(problemOf(history, "nowhere", 1.0), "");
}

TEST(TfHistory, ALoopIsNoChain) {
  TfHistory history("world");
  history.add(message({stampedTransform("a", "b", 1.0, 0.0), stampedTransform("b", "c", 1.0, 0.0),
                       stampedTransform("c", "a", 1.0, 0.0)}),
              false);
  EXPECT_NE(problemOf(history, "a", 1.0), "");
}

TEST(TfHistory, AFrameMayBecomeMovingOrStaticOrHaveAnotherParent) {
  TfHistory history("world");
  history.add(message({stampedTransform("world", "hand", 0.0, 1.0)}), true);
  EXPECT_TRUE(history.span("hand").is_static);
  long version = history.span("hand").version;
  const auto expectChange = [&](const std::string& change) {
    EXPECT_NE(history.span("hand").version, version);
    EXPECT_EQ(history.span("hand").change, change);
    version = history.span("hand").version;
  };
  history.add(message({stampedTransform("world", "hand", 0.0, 1.0)}), true);
  EXPECT_EQ(history.span("hand").version, version);

  history.add(message({stampedTransform("world", "hand", 10.0, 2.0)}), false);
  history.add(message({stampedTransform("world", "hand", 10.1, 3.0)}), false);
  expectChange("hand is no longer static");
  EXPECT_NEAR(xOf(history, "hand", 10.05), 2.5, 1e-9);
  EXPECT_EQ(history.span("hand").first, ros::Time(10.0));

  history.add(message({stampedTransform("world", "table", 0.0, 4.0)}), true);
  history.add(message({stampedTransform("table", "hand", 10.2, 1.0)}), false);
  history.add(message({stampedTransform("table", "hand", 10.3, 1.0)}), false);
  expectChange("hand has another parent, table instead of world");
  EXPECT_NEAR(xOf(history, "hand", 10.25), 5.0, 1e-9);
  EXPECT_NE(problemOf(history, "hand", 10.05), "");
  history.add(message({stampedTransform("world", "hand", 10.15, 0.0)}), false);  // from before the change
  EXPECT_EQ(history.span("hand").version, version);
  EXPECT_NEAR(xOf(history, "hand", 10.25), 5.0, 1e-9);

  history.add(message({stampedTransform("world", "hand", 0.0, 6.0)}), true);
  expectChange("hand has become static");
  EXPECT_EQ(history.span("hand").first, ros::Time(10.3));
  EXPECT_NE(problemOf(history, "hand", 10.25), "");  // before, another pose was reported for this time
  EXPECT_NEAR(xOf(history, "hand", 10.35), 6.0, 1e-9);
  EXPECT_NEAR(xOf(history, "hand", 0.0), 6.0, 1e-9);
  history.add(message({stampedTransform("world", "hand", 0.0, 7.0)}), true);
  expectChange("hand has another static transform");
}

TEST(TfHistory, StampsThatGoOnFarBehindBeginAnewAndASingleOneIsLate) {
  TfHistory history("world");
  for (const double stamp : {100.0, 100.1, 50.0, 100.2, 50.1, 100.3}) {
    history.add(message({stampedTransform("world", "hand", stamp, stamp)}), false);
  }
  EXPECT_EQ(history.span("hand").last, ros::Time(100.3));
  EXPECT_EQ(history.span("hand").first, ros::Time(100.0));
  for (const double stamp : {50.2, 50.3})
    history.add(message({stampedTransform("world", "hand", stamp, stamp)}), false);
  EXPECT_EQ(history.span("hand").last, ros::Time(50.3));
  EXPECT_EQ(history.span("hand").first, ros::Time(50.2));
  EXPECT_EQ(history.span("hand").change, "hand has stamps that went back");
}

TEST(TfHistory, WhatIsNoRigidMotionIsAProblemWhereItWas) {
  const auto withRotation = [](double stamp, double w) {
    geometry_msgs::TransformStamped sent = stampedTransform("world", "hand", stamp, 1.0);
    sent.transform.rotation.w = w;
    return sent;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  TfHistory history("world");
  history.add(message({withRotation(1.0, 1.004), withRotation(1.1, 1.0), withRotation(1.2, 1.02),
                       withRotation(1.3, 1.0), withRotation(1.4, nan), withRotation(1.5, 0.0), withRotation(1.6, 1.0),
                       stampedTransform("world", "hand", 1.7, nan), withRotation(1.8, 1.0),
                       stampedTransform("world", "hand", 1.9, 2e8)}),
              false);
  EXPECT_EQ(problemOf(history, "hand", 1.0), "");
  EXPECT_NEAR(xOf(history, "hand", 1.05), 1.0, 1e-15);
  EXPECT_EQ(problemOf(history, "hand", 1.1), "");
  for (const double time : {1.15, 1.2, 1.25, 1.45, 1.55})
    EXPECT_EQ(problemOf(history, "hand", time).empty(), false) << time;
  EXPECT_EQ(problemOf(history, "hand", 1.2), "hand has a rotation that is no unit quaternion");
  EXPECT_EQ(problemOf(history, "hand", 1.4), "hand has a transform that is not finite");
  EXPECT_EQ(problemOf(history, "hand", 1.7), "hand has a transform that is not finite");
  EXPECT_EQ(problemOf(history, "hand", 1.9), "hand is more than 1e+08 m from its parent");
  EXPECT_EQ(problemOf(history, "hand", 1.6), "");
}

TEST(TfHistory, AnEndlessChainIsNoChain) {
  TfHistory history("world");
  for (int i = 0; i < 100000; ++i) {
    history.add(message({stampedTransform("f" + std::to_string(i + 1), "f" + std::to_string(i), 1.0, 0.0)}), false);
  }
  EXPECT_EQ(problemOf(history, "f0", 1.0), "the transforms above f0 are more than 256");
}

TEST(TfHistory, ALoopIsNamedAndForgottenWithAllThatMoves) {
  TfHistory history("world");
  const auto send = [&](double time) {
    history.add(message({stampedTransform("world", "rail", time, 0.0), stampedTransform("rail", "arm", time, 1.0),
                         stampedTransform("arm", "hand", time, 1.0)}),
                false);
  };
  history.add(message({stampedTransform("hand", "finger", 0.0, 0.5)}), true);
  send(1.0);
  EXPECT_NEAR(xOf(history, "finger", 1.0), 2.5, 1e-12);
  history.add(message({stampedTransform("hand", "rail", 1.0, 0.0)}), false);
  EXPECT_EQ(problemOf(history, "finger", 1.0), "the transforms above finger are a loop: hand in arm in rail in hand");
  history.forgetMoving();
  EXPECT_FALSE(history.takeJump());
  EXPECT_NE(problemOf(history, "hand", 1.0), "");
  send(1.1);
  EXPECT_NEAR(xOf(history, "finger", 1.1), 2.5, 1e-12);
}

/// Whoever says that the fixed frame hangs on a link, once or for ever: the links below it are where they were.
TEST(TfHistory, WhatIsAboveTheFixedFrameIsOfNoConcernBelowIt) {
  for (const bool is_static : {false, true}) {
    TfHistory history("world");
    history.add(message({stampedTransform("world", "arm", 1.0, 1.0), stampedTransform("arm", "hand", 1.0, 1.0)}),
                false);
    history.add(message({stampedTransform("hand", "world", 1.0, 7.0)}), is_static);
    EXPECT_NEAR(xOf(history, "arm", 1.0), 1.0, 1e-12);
    EXPECT_NEAR(xOf(history, "hand", 1.0), 2.0, 1e-12);
  }
  TfHistory history("f0");
  history.add(message({stampedTransform("f0", "arm", 1.0, 1.0)}), false);
  for (int i = 0; i < 1000; ++i)
    history.add(message({stampedTransform("f" + std::to_string(i + 1), "f" + std::to_string(i), 1.0, 0.0)}), false);
  EXPECT_NEAR(xOf(history, "arm", 1.0), 1.0, 1e-12);
}

/// A frame that nobody else sends stays in a loop until its sender has been silent for as long as transforms are kept.
TEST(TfHistory, ALoopEndsWhenItsSenderIsSilent) {
  TfHistoryOptions options;
  options.wanted = {"hand", "table"};
  options.keep = 2.0;
  TfHistory history("odom", options);
  const auto send = [&](double time) {
    history.watchClock(ros::Time(time));
    history.add(message({stampedTransform("map", "odom", time, 5.0), stampedTransform("odom", "hand", time, 1.0)}),
                false);
  };
  history.add(message({stampedTransform("map", "table", 0.0, 6.0)}), true);
  send(1.0);
  EXPECT_NEAR(xOf(history, "table", 1.0), 1.0, 1e-12);
  history.add(message({stampedTransform("room", "map", 1.0, 0.0), stampedTransform("map", "room", 1.0, 0.0)}), false);
  EXPECT_NE(problemOf(history, "table", 1.0).find("a loop"), std::string::npos);
  EXPECT_NEAR(xOf(history, "hand", 1.0), 1.0, 1e-12);
  for (double time = 1.1; time < 6.0; time += 0.1) send(time);
  EXPECT_NEAR(xOf(history, "table", 5.5), 1.0, 1e-12);
}

}  // namespace sdf_ccd::tf_history_test
