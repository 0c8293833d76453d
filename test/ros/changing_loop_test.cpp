// Cycles of a complete monitor whose world changes.

#include <gtest/gtest.h>

#include "ros/loop_case.h"
#include "ros/messages/conversions.h"
#include "ros/monitor/proximity_measure.h"
#include "ros/tf/seconds_between.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::changing_loop_test {

using namespace test;

/// The same world as in MonitorLoopTest, but one that changes.
class ChangingLoopTest : public MonitorLoopTest {
 protected:
  ChangingLoopTest() : editor_(fine(0.005)) {
    description_.bodies = {body("hand", Sphere{kRadius}), body("foot", Sphere{kRadius}),
                           body("plate", Box::fromSize({2.0 * kPlateHalf, 1.0, 1.0}), true)};
    plate().X_frame_B.translation().x() = kPlate;
    const ScenePlan plan = planScene(description_);
    MonitorParameters parameters;
    parameters.monitor = soft();
    loop_ = std::make_unique<MonitorLoop>(
        checked(editor_.begin(description_, plan, buildScene(description_, plan, fine(0.005)))), describedWorld(),
        parameters);
  }

  BodyDescription& plate() { return description_.bodies[2]; }

  /// Makes the cycles continue with the present description.
  void change() { loop_->adopt(*loop_->prepare(checked(editor_.next(description_)))); }

  static std::shared_ptr<CheckedWorld> checked(const std::shared_ptr<const WorldSnapshot>& snapshot) {
    return std::make_shared<CheckedWorld>(snapshot);
  }

  SceneDescription description_;
  WorldEditor editor_;
};

TEST_F(ChangingLoopTest, WhatChangesAllTheTimeIsCheckedAgainstAFrameThatLagsBehind) {
  for (int i = 0; i < 60; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    sendHand(now - 4 * kPeriod, 0.02 * i);  // through the plate, which is moved repeatedly in that time
    step(now);
    if (i % 2 != 0) continue;
    plate().X_frame_B.translation().y() = i % 4 == 0 ? 0.0 : 0.01;
    change();
  }
  EXPECT_GT(verdicts(numberOf(Verdict::kContact)), 3);
  EXPECT_EQ(last().verdict, numberOf(Verdict::kClear)) << last().reason;
}

/// The next cycle need not test them, though a link moves.
TEST_F(ChangingLoopTest, WhatAppearsIsTestedInAdvance) {
  for (const auto& [parent, frame] :
       {std::pair("world", "room"), std::pair("room", "rack"), std::pair("rack", "shelf")}) {
    geometry_msgs::TransformStamped sent = stampedTransform(parent, frame, 10.0, 1.37);
    sent.transform.rotation.w = std::cos(0.35);
    sent.transform.rotation.z = std::sin(0.35);
    send(sent, true);
  }
  const auto cycle = [&](int i) {
    sendFoot(10.0 + i * kPeriod);
    sendHand(10.0 + i * kPeriod, 0.001 * i);
    step(10.0 + i * kPeriod);
  };
  for (int i = 0; i < 4; ++i) cycle(i);
  for (int i = 0; i < 20; ++i) {
    description_.bodies.push_back(body("object" + std::to_string(i), Box::fromSize({0.1, 0.04, 0.04}), i % 2 == 0));
    description_.bodies.back().frame = i % 2 == 0 ? "world" : "shelf";
    description_.bodies.back().X_frame_B = pose({0.1, 5.0 + 0.3 * i, 0.7}, 0.3 * i, {0, 0.6, 0.8});
  }
  change();
  cycle(4);
  cycle(5);
  const std::uint32_t pairs = last().cycle.checked + last().cycle.skipped;
  EXPECT_GT(pairs, 40u);
  for (const std::size_t back : {1u, 2u}) {
    const ContactArray& said = said_[said_.size() - back];
    EXPECT_EQ(said.verdict, numberOf(Verdict::kClear)) << said.reason;
    EXPECT_LT(said.cycle.checked, 3u) << said.cycle.skipped << " skipped";
  }
}

/// The indices of its pair and bodies are those of another scene.
TEST_F(ChangingLoopTest, AScaleThatStillRisesNamesNoPairOfTheLastScene) {
  ros::Time::init();
  ProximityParameters parameters;
  parameters.promise = StoppingPromise();
  ProximityMeasure measure(parameters, *loop_);
  MonitorState state;
  const auto cycle = [&](int i, double x) {
    const double now = 10.0 + i * kPeriod;
    ros::Time::setNow(ros::Time(now));
    sendFoot(now, -1.0);
    sendHand(now, x);
    if (step(now) == Step::kCycle) measure.setState(measure.measure(false), state);
  };
  for (int i = 0; i < 10; ++i) cycle(i, -1.8 + i * kPeriod);
  ASSERT_LT(state.velocity_scale, 1.0);
  EXPECT_EQ(state.velocity_limit.find("hand - foot: "), 0u) << state.velocity_limit;
  description_.bodies.erase(description_.bodies.begin() + 1);
  change();
  cycle(10, -1.5);
  ASSERT_LT(state.velocity_scale, 1.0);
  EXPECT_EQ(state.velocity_limit, "it rises slowly from what a pair of the last scene allowed");
}

/// Whatever keeps a new map away, the cycle tests the age of the one that it has.
TEST_F(ChangingLoopTest, AMapThatIsTooOldIsNotChecked) {
  const auto cycle = [&](int i) {
    sendFoot(10.0 + i * kPeriod);
    sendHand(10.0 + i * kPeriod, 0.0);
    step(10.0 + i * kPeriod);
  };
  for (const bool has_tile : {true, false}) {
    plate().map = has_tile ? "octomap" : "";
    const std::shared_ptr<CheckedWorld> world = checked(editor_.next(description_));
    world->map_age = std::make_shared<MapAge>("/map", 1.0, sinceEpoch(ros::Time(10.0)));
    loop_->adopt(*loop_->prepare(world));
    int i = has_tile ? 0 : 100;
    if (!has_tile) world->map_age->set(sinceEpoch(ros::Time(10.0 + 100 * kPeriod)));
    for (const int end = i + 25; i < end; ++i) cycle(i);
    EXPECT_EQ(last().verdict, numberOf(Verdict::kClear)) << last().reason;
    for (const int end = i + 10; i < end; ++i) cycle(i);
    EXPECT_EQ(last().verdict, numberOf(Verdict::kNotChecked));
    ASSERT_FALSE(last().unchecked.empty());
    EXPECT_EQ(last().unchecked[0].reason, "the last map on /map is older than 1 s (octomap/max_age)");
    EXPECT_EQ(last().cycle.not_checked, has_tile ? 2u : 3u) << "only the tile's pairs, if there is a tile";
    world->map_age->set(sinceEpoch(ros::Time(10.0 + i * kPeriod)));
    for (const int end = i + 10; i < end; ++i) cycle(i);
    EXPECT_EQ(last().verdict, numberOf(Verdict::kClear)) << "the same map was received again";
  }
}

TEST_F(ChangingLoopTest, AContactWithWhatGoesIsSaidToEnd) {
  const auto touch = [&](int i) {
    sendFoot(10.0 + i * kPeriod);
    sendHand(10.0 + i * kPeriod, kPlate - kRadius);
    step(10.0 + i * kPeriod);
  };
  for (int i = 0; i < 4; ++i) touch(i);
  ASSERT_EQ(last().contacts.size(), 1u);
  description_.bodies.pop_back();
  change();
  ASSERT_EQ(step(10.0 + 3 * kPeriod), Step::kWaiting);
  touch(4);
  ASSERT_EQ(last().contacts.size(), 1u);
  EXPECT_TRUE(last().contacts[0].ends && last().contacts[0].is_lost);
  touch(5);
  EXPECT_TRUE(last().contacts.empty());
}

}  // namespace sdf_ccd::changing_loop_test
