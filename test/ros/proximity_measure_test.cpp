// What a running monitor derives from its cycles: velocity scale, proximity, health.

#include "ros/monitor/proximity_measure.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "oracle/random.h"
#include "ros/loop_case.h"

namespace sdf_ccd::proximity_measure_test {

using namespace test;

constexpr double kFace = kPlate - kPlateHalf - kRadius;  // x at which the hand touches the plate [m]

ProximityParameters watched(double stop_distance = 0.02) {
  ProximityParameters parameters;
  parameters.thresholds = {0.05, stop_distance, 0.005};
  parameters.promise = StoppingPromise();
  parameters.promise->stop_distance = stop_distance;
  return parameters;
}

class ProximityMeasureTest : public MonitorLoopTest {
 protected:
  ProximityMeasureTest() { ros::Time::init(); }

  /// The state after a cycle at this time.
  MonitorState stateAt(double now, ProximityMeasure& measure) {
    ros::Time::setNow(ros::Time(now));
    EXPECT_EQ(step(now), Step::kCycle);
    MonitorState state;
    measure.setState(measure.measure(false), state);
    return state;
  }
};

TEST_F(ProximityMeasureTest, WhereNothingIsCheckedTheRobotStops) {
  loop_ = std::make_unique<MonitorLoop>(build({body("hand", Sphere{kRadius})}, fine(0.02)), describedWorld(),
                                        MonitorParameters());
  ProximityMeasure measure(watched(), *loop_);
  bool has_cycle = false;
  for (int i = 0; i < 5; ++i) {
    const double now = 10.0 + kPeriod * i;
    sendHand(now, 0.0);
    ros::Time::setNow(ros::Time(now));
    has_cycle = step(now) == Step::kCycle;
  }
  ASSERT_TRUE(has_cycle);
  MonitorState state;
  measure.setState(measure.measure(false), state);
  EXPECT_EQ(measure.safety().finding, CycleFinding::kNoPair);
  EXPECT_EQ(measure.safety().health, Health::kError);
  EXPECT_EQ(state.velocity_scale, 0.0);
  EXPECT_EQ(state.proximity, MonitorState::STOP);
  EXPECT_EQ(state.velocity_limit, "nothing is checked");
}

/// While transforms lag, the robot moves by what is known; not for long, and not once a pair is NOT_CHECKED.
TEST_F(ProximityMeasureTest, ADelayedPairCountsWithItsAge) {
  ProximityMeasure measure(watched(), *loop_);
  double now = 10.0;
  for (int i = 0; i < 5; ++i, now += kPeriod) {
    sendHand(now, -2.0);
    sendFoot(now, 4.0);
    if (i < 2) step(now);
  }
  ASSERT_EQ(stateAt(now - kPeriod, measure).velocity_scale, 1.0);
  EXPECT_EQ(measure.safety().health, Health::kOk);
  const double last = now - kPeriod;
  for (; now < last + 0.75; now += kPeriod) {
    sendHand(now, -2.0);
    const MonitorState state = stateAt(now, measure);
    const double age = now - last;
    if (age < 0.19) {
      EXPECT_EQ(state.velocity_scale, 1.0) << age;
      EXPECT_EQ(state.proximity, MonitorState::FREE) << age;
      EXPECT_EQ(measure.safety().health, Health::kWarn) << age;
    } else if (age > 0.21) {
      EXPECT_EQ(state.velocity_scale, 0.0) << age;
      EXPECT_EQ(state.proximity, MonitorState::STOP) << age;
      EXPECT_EQ(measure.safety().health, age < 0.45 ? Health::kWarn : measure.safety().health) << age;
      EXPECT_NE(state.velocity_limit, "") << age;
    }
  }
  EXPECT_EQ(measure.safety().finding, CycleFinding::kNotChecked);
  EXPECT_EQ(measure.safety().health, Health::kError);
}

TEST_F(ProximityMeasureTest, StateNamesThePairThatLimits) {
  ProximityMeasure measure(watched(), *loop_);
  double now = 10.0;
  MonitorState state;
  for (int i = 0; i < 6; ++i, now += kPeriod) {
    sendHand(now, kFace - 0.1);
    sendFoot(now);
    i < 3 ? static_cast<void>(step(now)) : static_cast<void>(state = stateAt(now, measure));
  }
  EXPECT_EQ(state.velocity_scale, 0.0);
  EXPECT_EQ(state.velocity_limit.find("hand - plate: 100 mm apart"), 0u) << state.velocity_limit;
  EXPECT_EQ(state.velocity_promise.find("if nothing but the robot moves"), 0u) << state.velocity_promise;
  EXPECT_EQ(state.proximity, MonitorState::FREE);
}

/// As a table and the robot's base that stands on it.
TEST_F(ProximityMeasureTest, WhatCannotMoveDoesNotCount) {
  ProximityMeasure measure(watched(), *loop_);
  sendHand(0.0, kFace - 0.01, true);
  double now = 10.0;
  MonitorState state;
  for (int i = 0; i < 6; ++i, now += kPeriod) {
    sendFoot(now, 4.0);
    i < 3 ? static_cast<void>(step(now)) : static_cast<void>(state = stateAt(now, measure));
  }
  EXPECT_EQ(state.velocity_scale, 1.0) << state.velocity_limit;
  EXPECT_EQ(state.proximity, MonitorState::FREE);
}

/// The hand, as a program drives it by the scale: it obeys late, and brakes and accelerates within its limits.
class ObedientHand {
 public:
  ObedientHand(const StoppingPromise& promise, double x) : promise_(promise), x_(x) {}

  void hear(double now, double scale, double delay) { heard_.push_back({now + delay, scale, now}); }

  void move(double now, double step, double wanted) {
    while (!heard_.empty() && heard_.front().from <= now) {
      scale_ = heard_.front().scale;
      sent_ = heard_.front().sent;
      heard_.pop_front();
    }
    if (now - sent_ > promise_.period + promise_.reaction_time) scale_ = 0.0;  // it has heard nothing
    const double limit = std::min(wanted, scale_ * promise_.max_speed);
    speed_ = std::clamp(limit, speed_ - promise_.deceleration * step, speed_ + promise_.max_acceleration * step);
    x_ += std::max(0.0, speed_) * step;
  }

  double x() const { return x_; }

 private:
  struct Heard {
    double from, scale, sent;
  };
  StoppingPromise promise_;
  std::deque<Heard> heard_;
  double x_, speed_ = 0.0, scale_ = 0.0, sent_ = -1e9;
};

/// Transforms arrive late, at random, also out of order; so do scales. The truth is the sphere's distance from the
/// face.
TEST_F(ProximityMeasureTest, ARobotThatObeysKeepsItsDistanceToTheWorldWhateverIsLate) {
  Random random(21);
  double nearest = 1e300;
  for (int run = 0; run < 12; ++run) {
    begin();
    ProximityParameters parameters = watched(0.01);
    StoppingPromise& promise = *parameters.promise;
    promise.max_speed = uniform(random, 0.5, 2.0);
    promise.reaction_time = uniform(random, 0.01, 0.15);
    promise.max_age = 0.3;
    ProximityMeasure measure(parameters, *loop_);
    ObedientHand hand(promise, kFace - uniform(random, 0.3, 2.5));
    struct Sent {
      double arrives;
      geometry_msgs::TransformStamped transform;
    };
    std::vector<Sent> sent;
    constexpr double kStep = 1e-3;
    double next_cycle = 10.0, lag = 0.0;
    for (int i = 0; i < 9000; ++i) {
      const double now = 10.0 + i * kStep;
      hand.move(now, kStep, promise.max_speed);
      nearest = std::min(nearest, kFace - hand.x());
      ASSERT_GE(kFace - hand.x(), promise.stop_distance - 2.0 * kStep * promise.max_speed) << run << " " << now;
      if (i % 500 == 0) lag = uniform(random, 0.0, 0.15);
      if (i % 10 == 0) {
        sent.push_back({now + uniform(random, 0.5, 1.0) * lag, stampedTransform("world", "hand", now, hand.x())});
        sent.push_back({now + uniform(random, 0.0, 1.0) * lag, stampedTransform("world", "foot", now, 4.0)});
      }
      const auto arrives = [&](const Sent& one) { return one.arrives <= now; };
      for (const Sent& one : sent)
        if (arrives(one)) send(one.transform);
      sent.erase(std::remove_if(sent.begin(), sent.end(), arrives), sent.end());
      if (now < next_cycle) continue;
      next_cycle = now + 0.02;
      ros::Time::setNow(ros::Time(now));
      if (loop_->step(ros::Time(now), {}) != Step::kCycle) continue;
      const CycleSafety& safety = measure.measure(false);
      hand.hear(now, *safety.velocity_scale, uniform(random, 0.0, 1.0) * promise.reaction_time);
    }
  }
  EXPECT_LT(nearest, 0.3);  // it comes near nevertheless
}

}  // namespace sdf_ccd::proximity_measure_test
