// Cycles of a complete monitor, from transforms to messages.

#include "ros/monitor/monitor_loop.h"
#include "ros/messages/conversions.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "oracle/busy_machine.h"
#include "oracle/scene_case.h"
#include "ros/loop_case.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::monitor_loop_test {

using namespace test;

/// Whether a message reports that there was no contact at a time.
bool saysClearAt(const ContactArray& contacts, double time) {
  return contacts.verdict == numberOf(Verdict::kClear) && contacts.cycle.start.toSec() <= time &&
         time <= contacts.cycle.complete_until.toSec();
}

TEST_F(MonitorLoopTest, AHandThatWasStaticIsCheckedWhenItMoves) {
  sendHand(0.0, 0.0, true);
  double crossing = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double now = 10.0 + i * kPeriod, x = i < 20 ? 0.0 : 0.2 * (i % 5);  // it passes the plate between two samples
    sendFoot(now);
    if (i >= 10) sendHand(now, x);
    step(now);
    if (i > 20 && i % 5 == 3) crossing = now - 0.5 * kPeriod;
    if (crossing > 0.0 && i % 5 == 3) {
      EXPECT_EQ(last().verdict, numberOf(Verdict::kContact)) << i;
    }
  }
  EXPECT_EQ(verdicts(numberOf(Verdict::kNotChecked)), 1);  // where it changes
  EXPECT_GE(verdicts(numberOf(Verdict::kContact)), 8);
  for (const ContactArray& said : said_) EXPECT_FALSE(saysClearAt(said, crossing));
}

TEST_F(MonitorLoopTest, AHandThatBecomesStaticIsCheckedThere) {
  for (int i = 0; i < 60; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    if (i < 20) sendHand(now, 0.0);
    if (i == 25) sendHand(now, kPlate - kRadius, true);
    step(now);
    if (i == 19) {
      EXPECT_EQ(last().verdict, numberOf(Verdict::kClear));
    }
    if (i > 20 && i < 25) {
      EXPECT_EQ(last().verdict, numberOf(Verdict::kNotChecked));
    }
    if (i == 25) {
      EXPECT_EQ(last().pairs.size(), 0u);
      ASSERT_EQ(last().unchecked.size(), 1u);
      EXPECT_EQ(last().unchecked[0].body, "hand");
      EXPECT_EQ(last().unchecked[0].reason, "hand has become static");
      EXPECT_EQ(last().unchecked[0].pairs, 2u);
      EXPECT_NEAR(last().unchecked[0].since.toSec(), 10.0 + 19 * kPeriod, 1e-6);
    }
    if (i > 25) {
      EXPECT_EQ(last().verdict, numberOf(Verdict::kContact)) << i;
    }
  }
}

TEST_F(MonitorLoopTest, AHandThatIsHandedOverIsNotCheckedMeanwhile) {
  send(stampedTransform("world", "table", 0.0, 1.0), true);
  for (int i = 0; i < 30; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    if (i < 10) sendHand(now, 0.0);
    if (i >= 11) send(stampedTransform("table", "hand", now, 0.0));  // behind the plate
    step(now);
    if (i >= 12) {
      EXPECT_EQ(last().verdict, numberOf(Verdict::kClear)) << i;
    }
  }
  ASSERT_EQ(verdicts(numberOf(Verdict::kNotChecked)), 2);  // delayed, then changed
  EXPECT_EQ(verdicts(numberOf(Verdict::kContact)), 0);
}

TEST_F(MonitorLoopTest, OneFrameWithTwoClocksDoesNotSilenceTheOthers) {
  int jumps = 0, foot_contacts = 0;
  for (int i = 0; i < 90; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendHand(now, 0.0);
    sendHand(now - 1.5, 0.0001 * i);  // another publisher, whose clock is late
    sendFoot(now, i < 60 ? kHigh : kPlate);
    jumps += step(now) == Step::kJump;
    if (i > 65) foot_contacts += pairOf(last(), "foot", "plate") != nullptr;
    if (i > 65) {
      EXPECT_FALSE(last().cycle.contradicted_since.isZero());
      EXPECT_EQ(last().cycle.late_frames, std::vector<std::string>{"hand"});
      ASSERT_EQ(last().unchecked.size(), 1u);  // 1.5 s is longer than max_cycle
      EXPECT_EQ(last().unchecked[0].body, "hand");
    }
  }
  EXPECT_EQ(jumps, 0);
  EXPECT_EQ(foot_contacts, 24);
}

TEST_F(MonitorLoopTest, ALateTransformIsToldAndItsTimeCheckedAgain) {
  for (int i = 0; i < 6; ++i) {
    const double now = 10.0 + 0.1 * i;
    sendHand(now, 0.0);
    sendFoot(now);
    step(now);
    if (i > 0) {
      EXPECT_EQ(last().verdict, numberOf(Verdict::kClear));
      EXPECT_TRUE(last().cycle.contradicted_since.isZero());
    }
  }
  sendHand(10.25, 0.6);  // between 10.2 and 10.3 it went through the plate and back
  sendHand(10.6, 0.0);
  sendFoot(10.6);
  ASSERT_EQ(step(10.6), Step::kCycle);
  EXPECT_EQ(last().cycle.contradicted_since, ros::Time(10.2));
  EXPECT_EQ(last().cycle.late_frames, std::vector<std::string>{"hand"});
  EXPECT_EQ(last().verdict, numberOf(Verdict::kContact));
  const PairContact* pair = pairOf(last(), "hand", "plate");
  ASSERT_NE(pair, nullptr);
  EXPECT_NEAR(pair->checked_from.toSec(), 10.2, 1e-6);
  EXPECT_EQ(pair->intervals.size(), 2u);
  EXPECT_EQ(last().cycle.complete_until, ros::Time(10.6));
  const MonitorState state = toMonitorState(*loop_, ros::Time(10.6));
  EXPECT_EQ(state.cycle.contradicted_since, ros::Time(10.2));
  sendHand(10.7, 0.0);
  sendFoot(10.7);
  ASSERT_EQ(step(10.7), Step::kCycle);
  EXPECT_TRUE(last().cycle.contradicted_since.isZero());
  EXPECT_EQ(last().verdict, numberOf(Verdict::kClear));
}

TEST_F(MonitorLoopTest, ACycleWithDelayedPairsIsNotClear) {
  for (int i = 0; i < 30; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    if (i < 10 || i >= 20) sendHand(now, 0.0);
    if (step(now) != Step::kCycle) continue;
    const bool is_delayed = i >= 10 && i < 20;
    EXPECT_EQ(last().verdict, is_delayed ? numberOf(Verdict::kNotChecked) : numberOf(Verdict::kClear)) << i;
    EXPECT_EQ(last().cycle.delayed, is_delayed ? 2u : 0u);
    EXPECT_NEAR(last().cycle.delayed_since.toSec(), is_delayed ? 10.0 + 9 * kPeriod : 0.0, 1e-6);
    EXPECT_EQ(last().reason.find("2 pairs wait for transforms") != std::string::npos, is_delayed) << last().reason;
    EXPECT_EQ(toMonitorState(*loop_, ros::Time(now)).reason, last().reason);
  }
}

TEST_F(MonitorLoopTest, AContactOfALatePairIsFoundWhereNothingNewerComes) {
  for (int i = 0; i < 10; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    if (i < 5) sendHand(now, 0.0);
    step(now);
  }
  sendHand(10.0 + 9 * kPeriod, 1.0);  // through the plate
  ASSERT_EQ(step(10.0 + 10 * kPeriod), Step::kCycle);
  EXPECT_EQ(last().cycle.start, last().header.stamp);
  EXPECT_EQ(last().cycle.complete_until, last().header.stamp);
  EXPECT_EQ(last().verdict, numberOf(Verdict::kContact));
  EXPECT_EQ(last().cycle.delayed, 0u);
  EXPECT_NE(pairOf(last(), "hand", "plate"), nullptr);
  ASSERT_EQ(last().contacts.size(), 1u);
  EXPECT_NEAR(last().contacts[0].begin.toSec(), 10.0 + kPeriod * (4 + 5 * (kPlate - kPlateHalf - kRadius)), 1e-3);
  EXPECT_EQ(step(10.0 + 11 * kPeriod), Step::kWaiting);
}

TEST_F(MonitorLoopTest, ALinkAboveTheFixedFrameStopsNothing) {
  const auto verdictFrom = [&](double begin) {
    for (int i = 0; i < 5; ++i) {
      sendFoot(begin + i * kPeriod);
      sendHand(begin + i * kPeriod, 0.0);
      step(begin + i * kPeriod);
    }
    return last().verdict;
  };
  EXPECT_EQ(verdictFrom(10.0), numberOf(Verdict::kClear));
  send(stampedTransform("hand", "world", 10.2, 0.0));
  EXPECT_EQ(verdictFrom(10.2), numberOf(Verdict::kClear));
  loop_->reset();
  EXPECT_EQ(verdictFrom(11.0), numberOf(Verdict::kClear));
}

TEST_F(MonitorLoopTest, AFixedFrameThatMovesWithItsWorldIsWarnedOf) {
  const auto driveTo = [&](double x) {
    for (int i = 0; i < 30; ++i) {
      const double now = 10.0 + i * kPeriod;
      sendHand(now, 0.0);
      sendFoot(now);
      send(stampedTransform("odom", "world", now, x * i / 29.0));
      step(now);
      loop_->watchFixedFrame();
    }
    return toMonitorState(*loop_, ros::Time(12.0)).warnings;
  };
  EXPECT_TRUE(driveTo(0.001).empty());
  begin();
  const std::vector<std::string> warnings = driveTo(0.5);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(
      warnings[0].find("the fixed frame world moves in odom, and objects of the world move with it, such as plate"), 0u)
      << warnings[0];
  EXPECT_EQ(toUncheckedState(1, "world", "", ros::Time(12.0), &loop_->warnings()).warnings, warnings);
  EXPECT_EQ(toUncheckedState(0, "", "building fields", ros::Time(), nullptr).proximity, MonitorState::STOP);
}

TEST_F(MonitorLoopTest, ALaggingFrameDoesNotLetOthersBeSampledAgain) {
  // The foot moves on a curve that needs additional samples; the hand, far away, is always 0.4 s late.
  std::size_t most_times = 0;
  for (int i = 0; i < 40; ++i) {
    const double now = 10.0 + i * kPeriod;
    send(stampedTransform("world", "cart", now, kHigh + 0.5 * i * kPeriod));
    geometry_msgs::TransformStamped foot = stampedTransform("cart", "foot", now, 0.3, 6.0 * i * kPeriod);
    send(foot);
    if (i >= 12) sendHand(now - 12 * kPeriod, 0.0);
    if (step(now) == Step::kCycle && i > 30) most_times = std::max(most_times, loop_->cycle().motion.times.size());
  }
  EXPECT_EQ(verdicts(numberOf(Verdict::kContact)), 0);
  // One of 13 periods is sampled for the foot and the plate; the foot and the hand need another one, 12 periods
  // earlier.
  EXPECT_LT(most_times, 20u);
}

TEST_F(MonitorLoopTest, SpeedsOfWhatIsInterpolatedAreBoundedByTheTimeBetweenItsTransforms) {
  constexpr double kAcceleration = 1.0, kGap = 0.1;  // the hand's [m/s², s]
  int measured = 0;
  for (int i = 0; i < 80; ++i) {
    const double now = 10.0 + 0.01 * i, t = 0.01 * i;
    sendFoot(now);
    if (i % 10 == 0) sendHand(now, 0.5 * kAcceleration * t * t);
    CycleRequest request;
    request.skipped_pairs = true;
    if (loop_->step(ros::Time(now), request) != Step::kCycle) continue;
    for (const PairDistance& pair : loop_->measureDistances(0.5)) {
      if (pair.body_a != 0 || pair.body_b != 2) continue;
      const double speed = kAcceleration * (loop_->cycle().origin.toSec() + pair.time - 10.0);
      EXPECT_GE(pair.any.closing + 0.5 * kAcceleration * pair.any.over, speed - 1e-6) << i;
      EXPECT_LE(pair.any.over, kGap + 1e-6);
      EXPECT_NEAR(std::fmod(speed / kAcceleration + 1e-6, kGap), 0.0, 1e-5) << "it is known at its transforms' times";
      ++measured;
    }
  }
  EXPECT_GT(measured, 50);
}

TEST_F(MonitorLoopTest, StampsFarAheadStopNothing) {
  for (int i = 0; i < 20; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    geometry_msgs::TransformStamped far = stampedTransform("world", "hand", now, 0.0);
    far.header.stamp = i % 2 == 0 ? ros::TIME_MAX : ros::Time(1u << 31, 0);
    send(far);
    if (i < 10) sendHand(now, 0.0);
    step(now);
  }
  EXPECT_EQ(verdicts(numberOf(Verdict::kClear)), 9);
  EXPECT_EQ(verdicts(numberOf(Verdict::kNotChecked)), 10);
}

TEST(MonitorLoop, TwoArmsThatMeetBetweenTheirTransformsAreNotClear) {
  // Two arms of 0.8 m on one base rotate at 2 rad/s each; their tips meet only in the middle between two transforms.
  constexpr double kArm = 0.8, kTip = 0.02, kDepth = 0.003, kRate = 2.0, kStep = 0.1;
  const auto tip = [](const std::string& name) {
    BodyDescription arm = body(name, Sphere{kTip});
    arm.geometry[0].X_BG.translation().x() = kArm;
    return arm;
  };
  MonitorParameters parameters;
  parameters.monitor = soft();
  MonitorLoop loop(build({tip("left"), tip("right")}, fine(0.001)), describedWorld(), parameters);
  loop.history().add(message({stampedTransform("world", "right_base", 0.0, 2.0 * (kArm + kTip) - kDepth)}), true);
  int cycles = 0;
  for (int i = 0; i < 2; ++i) {
    const double now = 10.0 + kStep * i, angle = kRate * kStep * (i - 0.5);
    loop.history().add(message({stampedTransform("world", "left", now, 0.0, angle),
                                stampedTransform("right_base", "right", now, 0.0, M_PI - angle)}),
                       false);
    if (loop.step(ros::Time(now), {}) != Step::kCycle) continue;
    ++cycles;
    EXPECT_EQ(loop.result().verdict, Verdict::kContact) << "bound " << loop.result().error_bound;
    EXPECT_NEAR(loop.result().pairs[0].deepest.depth, kDepth, loop.result().error_bound);
  }
  EXPECT_EQ(cycles, 1);
}

TEST_F(MonitorLoopTest, GapsUpToMaxCycleAreCheckedHoweverLongThatIs) {
  begin(30.0, 30.0);
  const auto both = [&](double time, double x) {
    sendHand(time, x);
    sendFoot(time);
    step(time);
  };
  for (const double time : {100.0, 100.1, 100.2}) both(time, 0.0);
  said_.clear();
  both(120.0, 1.0);  // through the plate
  both(120.1, 1.0);
  ASSERT_FALSE(said_.empty());
  const PairContact* pair = pairOf(said_.front(), "hand", "plate");
  ASSERT_NE(pair, nullptr);
  EXPECT_EQ(pair->verdict, numberOf(Verdict::kContact)) << pair->reason;
}

TEST_F(MonitorLoopTest, PublishersThatDisagreeForEverLetCyclesGoOnAndRecover) {
  begin();
  double now = 100.0;
  for (int i = 0; i < 90; ++i) {
    for (int k = 0; k < 33; ++k, now += 1e-3) {
      sendHand(now, 0.01 * (k % 2));
      sendHand(now - 0.9, 0.3);
      sendFoot(now);
    }
    const auto start = std::chrono::steady_clock::now();
    step(now);
    EXPECT_LT(std::chrono::steady_clock::now() - start, slowness() * std::chrono::seconds(1)) << i;
  }
  EXPECT_GT(said_.size(), 80u);
  said_.clear();
  for (int i = 0; i < 60; ++i, now += kPeriod) {
    sendHand(now, 0.0);
    sendFoot(now);
    step(now);
  }
  EXPECT_EQ(last().verdict, numberOf(Verdict::kClear));
  EXPECT_LT(verdicts(numberOf(Verdict::kNotChecked)), 30);
}

}  // namespace sdf_ccd::monitor_loop_test
