// Cycles of a complete monitor whose world changes.

#include <gtest/gtest.h>

#include "ros/loop_case.h"
#include "sdf_ccd/monitor/world.h"

namespace sdf_ccd {
namespace {

using namespace test;

/// The same world as in MonitorLoopTest, but one that changes.
class ChangingLoopTest : public MonitorLoopTest {
 protected:
  ChangingLoopTest() : editor_(fine(0.005)) {
    description_.bodies = {body("hand", Sphere{kRadius}), body("foot", Sphere{kRadius}),
                           body("plate", Box{Vector3d(kPlateHalf, 0.5, 0.5)}, true)};
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

  static std::shared_ptr<const CheckedWorld> checked(const std::shared_ptr<const WorldSnapshot>& snapshot) {
    return std::make_shared<const CheckedWorld>(snapshot, std::vector<UnreachablePair>());
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
  EXPECT_GT(verdicts(ContactArray::CONTACT), 3);
  EXPECT_EQ(last().verdict, ContactArray::CLEAR) << last().reason;
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

}  // namespace
}  // namespace sdf_ccd
