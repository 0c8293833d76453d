// What the messages of a complete monitor's cycles say.

#include "ros/monitor/cycle_messages.h"
#include "ros/messages/conversions.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/scene_case.h"
#include "ros/loop_case.h"
#include "ros/monitor/plan_message.h"
#include "ros/monitor/unchecked.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::cycle_messages_test {

using namespace test;

using CycleMessagesTest = MonitorLoopTest;

TEST_F(CycleMessagesTest, TheCauseOfWhatIsNotCheckedIsNamed) {
  step(100.0);
  EXPECT_EQ(uncheckedCause(*loop_).find("hand: no transform from hand to world: no transform of hand was received"), 0u)
      << uncheckedCause(*loop_);
  for (int i = 0; i < 30; ++i) {
    const double time = 100.0 + kPeriod * i;
    for (const char* link : {"hand", "foot"}) send(stampedTransform("base", link, time, 0.1));
    step(time + 0.01);
  }
  EXPECT_EQ(uncheckedCause(*loop_),
            "hand: no transform from hand to world: tf's tree is rooted at base, not world; and 1 more body");
}

TEST_F(CycleMessagesTest, ACheckThatFailsIsToldOfItsWholeTime) {
  Scene broken = *handFootAndPlate();
  std::vector<Body> bodies(broken.bodies.begin(), broken.bodies.end());
  bodies[0].X_frame_B.linear() *= 1.1;  // not a rotation
  broken.bodies = BodyList(std::move(bodies));
  MonitorParameters parameters;
  parameters.monitor = soft();
  loop_ = std::make_unique<MonitorLoop>(std::make_shared<const Scene>(broken), describedWorld(), parameters);
  ros::Time end;
  for (int i = 0; i < 10; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendHand(now, 0.1 * i);
    sendFoot(now);
    ASSERT_EQ(step(now), i == 0 ? Step::kWaiting : Step::kCycle);
    if (i == 0) continue;
    EXPECT_EQ(last().verdict, numberOf(Verdict::kNotChecked));
    EXPECT_EQ(last().cycle.not_checked, 3u);
    if (!end.isZero()) {
      EXPECT_EQ(last().cycle.start, end);
    }
    end = last().header.stamp;
    ASSERT_EQ(last().unchecked.size(), 3u);
    EXPECT_EQ(last().unchecked[0].pairs, 2u);
    EXPECT_EQ(last().reason.find("3 pairs could not be checked, for example hand - "), 0u) << last().reason;
    EXPECT_NE(last().unchecked[0].reason.find("orthonormal"), std::string::npos) << last().unchecked[0].reason;
  }
}

TEST_F(CycleMessagesTest, TheWrenchOnWhatALinkHoldsIsAboutTheLinksOrigin) {
  constexpr double kAside = 0.2;  // of the object's origin from the link's, along y [m]
  BodyDescription held = body("held", Sphere{kRadius}),
                  plate = body("plate", Box::fromSize({2.0 * kPlateHalf, 1.0, 1.0}), true);
  held.frame = "hand";
  held.X_frame_B = translation({0.0, kAside, 0.0}) * pose({0, 0, 0}, 1.0, Vector3d(1, 2, 3).normalized());
  plate.geometry[0].X_BG.translation().x() = kPlate;
  MonitorParameters parameters;
  parameters.monitor = soft();
  loop_ = std::make_unique<MonitorLoop>(build({held, plate}, fine(0.005)), describedWorld(), parameters);
  for (int i = 0; i < 3; ++i) {
    sendHand(10.0 + i * kPeriod, kPlate - kRadius);
    step(10.0 + i * kPeriod);
  }
  ASSERT_EQ(last().verdict, numberOf(Verdict::kContact)) << last().reason;
  const geometry_msgs::WrenchStamped wrench = toWrenchStamped(*loop_, 0);
  EXPECT_EQ(wrench.header.frame_id, "hand");
  const double force = wrench.wrench.force.x;
  EXPECT_LT(force, -0.1);
  EXPECT_NEAR(wrench.wrench.force.y, 0.0, 0.01 * std::abs(force));
  EXPECT_NEAR(wrench.wrench.force.z, 0.0, 0.01 * std::abs(force));
  EXPECT_NEAR(wrench.wrench.torque.z, -kAside * force, 0.02 * kAside * std::abs(force));
  EXPECT_NEAR(wrench.wrench.torque.x, 0.0, 0.02 * kAside * std::abs(force));
}

TEST_F(CycleMessagesTest, BodiesThatWereNotBuiltAreNamedInEachCycle) {
  const auto scene =
      build({body("hand", Sphere{kRadius}), body("foot", meshShape({})), body("plate", meshShape({}), true)});
  loop_ = std::make_unique<MonitorLoop>(scene, describedWorld(), MonitorParameters());
  for (int i = 0; i < 4; ++i) {
    if (i < 3) sendHand(10.0 + i * kPeriod, 0.0);
    sendFoot(10.0 + i * kPeriod);
    step(10.0 + i * kPeriod);
  }
  ASSERT_GE(said_.size(), 2u);
  for (const ContactArray& said : said_) {
    EXPECT_EQ(said.verdict, numberOf(Verdict::kNotChecked));
    EXPECT_EQ(said.cycle.not_checked, 3u);
    EXPECT_TRUE(said.pairs.empty());
    ASSERT_EQ(said.unchecked.size(), 2u);
    EXPECT_EQ(said.unchecked[0].body + " " + said.unchecked[1].body, "foot plate");
    EXPECT_EQ(said.unchecked[0].reason, scene->bodies[1].failure);
    EXPECT_EQ(said.unchecked[0].pairs, 2u);
    EXPECT_EQ(said.unchecked[0].since, said.cycle.start);
    EXPECT_NE(said.reason.find("3 pairs could not be checked, for example hand - foot: "), std::string::npos);
  }
  const MonitorState state = toMonitorState(*loop_, ros::Time(10.2));
  EXPECT_EQ(state.unchecked, last().unchecked);
  EXPECT_EQ(state.cycle, last().cycle);
}

TEST_F(CycleMessagesTest, ThePlanSaysWhatIsCheckedAndWhyTheRestIsNot) {
  BodyDescription finger = body("finger", Sphere{kRadius});
  finger.frame = "hand";
  const auto scene = build({body("hand", Sphere{kRadius}), finger, body("foot", meshShape({})),
                            body("ground", HalfSpace{Vector3d::UnitZ(), -9.0}, true)});
  loop_ = std::make_unique<MonitorLoop>(scene, describedWorld(), MonitorParameters());
  const Plan plan = toPlan(*loop_->world(), "world", ros::Time(1.0));
  ASSERT_EQ(plan.bodies.size(), 4u);
  EXPECT_EQ(plan.bodies[1].name + " in " + plan.bodies[1].frame, "finger in hand");
  EXPECT_EQ(plan.bodies[2].failure, scene->bodies[2].failure);
  EXPECT_TRUE(plan.bodies[3].is_world && !plan.bodies[0].is_world);
  EXPECT_EQ(plan.bodies[0].surface.state, PlanPart::READY);
  EXPECT_EQ(plan.bodies[2].surface.state, PlanPart::FAILED);
  EXPECT_EQ(plan.bodies[3].shell.state, PlanPart::NOT_NEEDED);
  EXPECT_NE(plan.bodies[3].shell.text, "") << "a plane cannot be covered with points";
  std::vector<std::string> checked;
  for (const PlanPair& pair : plan.checked)
    checked.push_back(plan.bodies[pair.body_a].name + " - " + plan.bodies[pair.body_b].name);
  EXPECT_EQ(checked, (std::vector<std::string>{"hand - foot", "hand - ground", "finger - foot", "finger - ground",
                                               "foot - ground"}));
  ASSERT_EQ(plan.left_out.size(), 1u);
  EXPECT_EQ(plan.left_out[0].body_a + plan.left_out[0].body_b, 1u);
  EXPECT_EQ(plan.left_out[0].kind, LeftOutPair::RIGID);
  EXPECT_NE(plan.left_out[0].reason, "");
}

TEST_F(CycleMessagesTest, AForceThatIsNotKnownIsNoNumber) {
  const auto scene = build(
      {body("hand", meshShape(icosphere(0.2, 4))), body("plate", meshShape(icosphere(0.2, 4)), true)}, fine(0.001));
  loop_ = std::make_unique<MonitorLoop>(scene, describedWorld(), MonitorParameters());
  CycleRequest request;
  // Some time suffices for the verdict, but not for the contact, however busy the machine is.
  request.max_time = 5e-4;
  for (int i = 0; i < 60 && (i < 2 || loop_->result().incomplete == 0); ++i) {
    sendHand(10.0 + i * kPeriod, 0.3 + 0.01 * (i % 2));
    loop_->step(ros::Time(10.0 + i * kPeriod), request);
    request.max_time *= 1.2;
  }
  const ContactArray said = toContactArray(*loop_);
  ASSERT_EQ(said.pairs.size(), 1u);
  EXPECT_EQ(said.verdict, numberOf(Verdict::kContact));
  EXPECT_EQ(said.cycle.incomplete, 1u);
  EXPECT_TRUE(said.pairs[0].incomplete);
  EXPECT_NE(said.pairs[0].reason.find("incomplete"), std::string::npos);
  EXPECT_TRUE(std::isnan(said.pairs[0].wrench_on_a.force.x));
  EXPECT_GE(said.pairs[0].deepest.depth + said.pairs[0].deepest.depth_error, 0.1);
  EXPECT_TRUE(std::isnan(toWrenchStamped(*loop_, 0).wrench.force.x));
  const MonitorState state = toMonitorState(*loop_, ros::Time(10.2));
  EXPECT_EQ(state.cycle.incomplete, 1u);
  EXPECT_TRUE(std::isnan(state.max_force) && std::isnan(state.max_depth));
}

TEST_F(CycleMessagesTest, WhyAPairOfKnownBodiesIsNotCheckedIsSaid) {
  Scene joined = *handFootAndPlate();
  const auto rigid = std::make_shared<const RigidPose>(RigidPose{Isometry3d::Identity(), {}, {}});
  joined.left_out.push_back({"hand", "foot", "rigidly joined", PairKind::kRigid, 0.0, rigid, 0, 1});
  loop_ = std::make_unique<MonitorLoop>(std::make_shared<const Scene>(joined), describedWorld(), MonitorParameters());
  for (int i = 0; i < 3; ++i) {
    sendHand(10.0 + i * kPeriod, 0.0);
    sendFoot(10.0 + i * kPeriod, 0.15);
    step(10.0 + i * kPeriod);
  }
  ASSERT_EQ(last().verdict, numberOf(Verdict::kNotChecked));
  ASSERT_EQ(last().pairs.size(), 1u);
  ASSERT_NE(last().pairs[0].reason, "");
  EXPECT_EQ(uncheckedPair(*loop_), "hand - foot: " + last().pairs[0].reason);
  EXPECT_EQ(last().reason, "1 pair could not be checked, for example " + uncheckedPair(*loop_));
  EXPECT_EQ(toMonitorState(*loop_, ros::Time(10.0)).reason, last().reason);
  EXPECT_EQ(toMonitorState(*loop_, ros::Time(10.0)).min_clearance, 0.0);
  EXPECT_EQ(uncheckedCause(*loop_), "");
}

TEST_F(CycleMessagesTest, ValuesThatWereNotComputedAreNoNumbers) {
  for (int i = 0; i < 3; ++i) {
    sendFoot(10.0 + i * kPeriod);
    sendHand(10.0 + i * kPeriod, kPlate);
    CycleRequest nothing;
    nothing.wrenches = nothing.contacts = nothing.skipped_pairs = false;
    loop_->step(ros::Time(10.0 + i * kPeriod), nothing);
  }
  const MonitorState state = toMonitorState(*loop_, ros::Time(10.2));
  EXPECT_EQ(state.verdict, numberOf(Verdict::kContact));
  EXPECT_TRUE(std::isnan(state.max_depth) && std::isnan(state.max_force) && std::isnan(state.min_clearance));
}

TEST_F(CycleMessagesTest, AContactHasOneIdFromItsBeginToItsEnd) {
  std::vector<Contact> told;
  for (int i = 0; i < 30; ++i) {
    const double now = 10.0 + i * kPeriod;
    sendFoot(now);
    sendHand(now, 0.03 * i);  // through the plate
    if (step(now) != Step::kCycle) continue;
    const MonitorState state = toMonitorState(*loop_, ros::Time(now));
    EXPECT_EQ(state.contacts, last().contacts.size());
    EXPECT_EQ(state.max_depth > 0.0, !last().pairs.empty());
    EXPECT_EQ(state.max_force > 0.0, !last().pairs.empty());
    EXPECT_EQ(state.min_clearance > 0.0, last().verdict == numberOf(Verdict::kClear));
    told.insert(told.end(), last().contacts.begin(), last().contacts.end());
  }
  ASSERT_GT(told.size(), 3u);
  EXPECT_TRUE(told.front().begins);
  EXPECT_TRUE(told.back().ends);
  for (std::size_t i = 0; i < told.size(); ++i) {
    EXPECT_EQ(told[i].id, 1u);
    EXPECT_EQ(told[i].begins, i == 0);
    EXPECT_EQ(told[i].ends, i + 1 == told.size());
  }
  EXPECT_NEAR((told.back().begin - ros::Time(10.0)).toSec(), (kPlate - kPlateHalf - kRadius) / 0.03 * kPeriod, 1e-3);
  EXPECT_NEAR((told.back().end - ros::Time(10.0)).toSec(), (kPlate + kPlateHalf + kRadius) / 0.03 * kPeriod, 1e-3);
  EXPECT_EQ(told.back().verdict, numberOf(Verdict::kContact));
  EXPECT_GT(told.back().max_force, 0.0);
  EXPECT_EQ(told.back().cycles, told.size());
}

TEST_F(CycleMessagesTest, ResetsAndJumpsEndAllContacts) {
  const auto touch = [&](double from) {
    for (int i = 0; i < 5; ++i) {
      sendFoot(from + i * kPeriod);
      sendHand(from + i * kPeriod, kPlate - kRadius);
      step(from + i * kPeriod);
    }
    return from + 4 * kPeriod;
  };
  touch(10.0);
  ASSERT_EQ(last().contacts.size(), 1u);
  loop_->reset();
  ContactArray told = toUncheckedContacts(*loop_, "reset");
  ASSERT_EQ(told.contacts.size(), 1u);
  EXPECT_TRUE(told.contacts[0].ends && told.contacts[0].is_lost);
  const double end = touch(11.0);
  ASSERT_EQ(last().contacts.size(), 1u);
  EXPECT_EQ(last().contacts[0].id, 2u);
  // While no transforms come, the contact is reported unchanged.
  ASSERT_EQ(step(end + 0.6), Step::kStalled);
  told = toUncheckedContacts(*loop_, "no new transforms");
  ASSERT_EQ(told.contacts.size(), 1u);
  EXPECT_FALSE(told.contacts[0].begins || told.contacts[0].ends);
  sendFoot(5.0);
  sendHand(5.0, 0.0);
  ASSERT_EQ(step(5.0), Step::kJump);
  told = toUncheckedContacts(*loop_, "time has jumped");
  ASSERT_EQ(told.contacts.size(), 1u);
  EXPECT_TRUE(told.contacts[0].is_lost);
  touch(5.1);
  EXPECT_EQ(last().contacts[0].id, 3u);
}

}  // namespace sdf_ccd::cycle_messages_test
