// From transforms to the message about contacts, nothing is allocated once the history holds all that it keeps.

#include <gtest/gtest.h>

#include <algorithm>

#include "allocations.h"
#include "oracle/files.h"
#include "oracle/scene_case.h"
#include "ros/described_world.h"
#include "ros/messages/conversions.h"
#include "ros/messages/message_pool.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/cycle_snapshot.h"
#include "ros/monitor/health_watch.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/monitor/proximity_measure.h"
#include "ros/monitor/torque_output.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::tf_allocation_test {

using test::stampedTransform;

constexpr int kLinks = 10;
constexpr double kPeriod = 0.01;  // [s]

/// What may keep an arm from moving at full scale.
struct Troubles {
  bool is_body_bad = false;   ///< a body without a mesh
  int slow_frame_period = 1;  ///< number of messages of which one has the last link's transform
};

/// An arm of balls that bends back and forth above a ground, between a static base and a static tool.
class Arm {
 public:
  explicit Arm(double height, const Troubles& troubles = {}) : slow_frame_period_(troubles.slow_frame_period) {
    ros::Time::init();
    std::vector<BodyDescription> bodies = {test::body("ground", test::ground(), true)};
    for (int link = 0; link < kLinks; ++link) bodies.push_back(test::body(name(link), Sphere{0.02}));
    bodies.push_back(test::body("tool", Sphere{0.02}));
    if (troubles.is_body_bad) {
      bodies.push_back(test::body("a_body_of_which_the_mesh_is_bad", Sphere{0.02}, true));
      bodies.back().failure = "a mesh that cannot be read, for a reason that takes some words";
    }
    MonitorParameters parameters;
    parameters.monitor = test::soft();
    parameters.proximity.promise = StoppingPromise();
    loop_ = std::make_unique<MonitorLoop>(test::build(bodies), test::describedWorld(), parameters);
    Quaterniond upright = Quaterniond::Identity();
    loop_->history().add(test::message({stampedTransform("/world", "base", ros::Time(), upright, {0.0, 0.0, height}),
                                        stampedTransform(name(kLinks - 1), "tool", 0.0, 0.1)}),
                         true);
    for (int link = 0; link < kLinks; ++link) {
      message_.transforms.push_back(stampedTransform(link == 0 ? "base" : name(link - 1), "/" + name(link), 0.0, 0.1));
    }
    slow_ = message_;
    slow_.transforms.pop_back();
    measure_ = std::make_unique<ProximityMeasure>(parameters.proximity, *loop_);
  }

  /// One second of motion that ends where it begins.
  void move() {
    for (int i = 0; i < 100; ++i, ++now_) {
      const ros::Time now = ros::Time(100.0) + ros::Duration(kPeriod * now_);
      const double yaw = 0.02 * std::sin(2.0 * M_PI * i / 100.0);
      tf2_msgs::TFMessage& message = now_ % slow_frame_period_ == 0 ? message_ : slow_;
      for (geometry_msgs::TransformStamped& transform : message.transforms) {
        transform.header.stamp = now;
        transform.transform.rotation.w = std::cos(0.5 * yaw);
        transform.transform.rotation.z = std::sin(0.5 * yaw);
      }
      ros::Time::setNow(now);
      loop_->history().watchClock(now);
      loop_->history().add(message, false);
      if (loop_->step(now, {true, 5}) != TfTracker::Step::kCycle) continue;
      const boost::shared_ptr<ContactArray> contacts = contacts_.acquire();
      setContactArray(*loop_, *contacts);
      const boost::shared_ptr<MonitorState> state = states_.acquire();
      setMonitorState(*loop_, now, *state);
      measure_->setState(measure_->measure(false), *state);
      health_.recordCycle(*loop_, *state, measure_->safety(), now);
      limited_ += state->velocity_scale < 1.0 && !state->velocity_limit.empty();
      warned_ += !health_.health().finding.empty();
      loop_->measureDistances(0.5);
      const boost::shared_ptr<DistanceArray> distances = distances_.acquire();
      setDistanceArray(*loop_, 0.5, *distances);
      EXPECT_FALSE(distances->distances.empty());
      ++cycles_[contacts->verdict];
    }
  }

  int cycles(std::uint8_t verdict) const { return cycles_[verdict]; }
  int limited() const { return limited_; }  ///< cycles with a scale below 1, and the reason for it
  int warned() const { return warned_; }    ///< cycles of which the diagnostics have something to say

 private:
  static std::string name(int link) { return "a_link_with_a_long_name_" + std::to_string(link); }

  int slow_frame_period_;
  std::unique_ptr<MonitorLoop> loop_;
  std::unique_ptr<ProximityMeasure> measure_;
  HealthWatch health_;
  tf2_msgs::TFMessage message_, slow_;
  MessagePool<ContactArray> contacts_;
  MessagePool<MonitorState> states_;
  MessagePool<DistanceArray> distances_;
  long now_ = 0;
  int cycles_[4] = {0, 0, 0, 0}, limited_ = 0, warned_ = 0;
};

/// A gripper of meshes whose sliding finger is pressed on a wall, far from a ball.
class Gripper {
 public:
  Gripper() {
    MonitorParameters parameters = parseParameters({}, "~");
    parameters.urdf = test::readText(std::string(SDF_CCD_SOURCE_DIR) + "/test/ros/gripper.urdf");
    parameters.scene.cache_directory.clear();
    parameters.scene.shell.spacing = 0.004;
    parameters.world = {object("wall", Box::fromSize({0.02, 0.6, 0.1}), 0.146), object("ball", Sphere{0.05}, 1.0)};
    const PackageFinder packages = [](const std::string&) { return std::string(SDF_CCD_SOURCE_DIR); };
    described_ =
        describeScene(parameters, [&](const std::string& uri) { return loadLocalResource(uri, packages, ""); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    const auto scene = buildDescribed(described_, plan, parameters.scene, {});
    loop_ = std::make_unique<MonitorLoop>(scene, described_, parameters);
    health_.recordScene(*scene, described_, parameters);
    torques_ = std::make_unique<TorqueOutput>(described_);
    std::vector<int> links = torques_->linksOf(*scene);
    torques_->swapLinks(links);
  }

  /// One second of motion that ends where it begins, and all that the thread of the cycles does about it.
  void move() {
    for (int i = 0; i < 100; ++i, ++now_) {
      const ros::Time now = ros::Time(100.0) + ros::Duration(kPeriod * now_);
      const double swing = std::sin(2.0 * M_PI * i / 100.0);
      sent_.transforms[0].transform.rotation.w = std::cos(0.005 * swing);
      sent_.transforms[0].transform.rotation.z = std::sin(0.005 * swing);
      sent_.transforms[1].transform.translation.y = 0.01 * swing;
      for (geometry_msgs::TransformStamped& transform : sent_.transforms) transform.header.stamp = now;
      loop_->history().watchClock(now);
      loop_->history().add(sent_, false);
      if (loop_->step(now, request()) == TfTracker::Step::kCycle) report(now);
    }
  }

  int contacts() const { return contacts_; }
  int measuredTorques() const { return measured_torques_; }

 private:
  static WorldObject object(const std::string& name, const Primitive& shape, double x) {
    WorldObject object;
    object.name = name;
    object.frame = "base";
    object.shapes = {{shape}};
    object.X_frame_B.translation().x() = x;
    return object;
  }

  static CycleRequest request() {
    CycleRequest request{true, 20};
    request.wrenches = request.skipped_pairs = true;
    return request;
  }

  void report(const ros::Time& now) {
    const boost::shared_ptr<ContactArray> contacts = contacts_pool_.acquire();
    setContactArray(*loop_, *contacts);
    const boost::shared_ptr<MonitorState> state = states_.acquire();
    setMonitorState(*loop_, now, *state);
    for (int body = 0; body < 2; ++body) setWrenchStamped(*loop_, body, wrench_);
    const boost::shared_ptr<sensor_msgs::JointState> torques = torques_->toMessage(*loop_);
    snapshot_.copyFrom(*loop_);
    CycleSafety safety;  // as of a cycle in contact
    safety.finding = CycleFinding::kContact;
    safety.health = Health::kOk;
    health_.recordCycle(*loop_, *state, safety, now);
    contacts_ += contacts->verdict == numberOf(Verdict::kContact) && !contacts->pairs.empty();
    measured_torques_ += std::abs(torques->effort.at(0)) > 1e-3;
  }

  DescribedScene described_;
  std::unique_ptr<MonitorLoop> loop_;
  std::unique_ptr<TorqueOutput> torques_;
  HealthWatch health_;
  CycleSnapshot snapshot_;
  tf2_msgs::TFMessage sent_ =
      test::message({stampedTransform("base", "palm", 0.0, 0.0), stampedTransform("palm", "finger", 0.0, 0.1)});
  MessagePool<ContactArray> contacts_pool_;
  MessagePool<MonitorState> states_;
  geometry_msgs::WrenchStamped wrench_;
  long now_ = 0;
  int contacts_ = 0, measured_torques_ = 0;
};

/// Allocations during the last second, after more seconds than the history keeps.
template <class Robot>
long steadyAllocations(Robot& robot) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (int second = 0; second < 14; ++second) robot.move();
  const test::ThreadAllocations allocations;
  robot.move();
  return allocations.count();
}

TEST(TfAllocation, NoneFromTransformsToTheMessageWhileAllIsClear) {
  Arm arm(1.0);
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(numberOf(Verdict::kClear)), 1400);
}

TEST(TfAllocation, NoneFromTransformsToTheMessageOfContactsLikeTheLast) {
  Arm arm(0.015);
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(numberOf(Verdict::kContact)), 1400);
}

TEST(TfAllocation, NoneWhileANearPairLimitsTheVelocityScale) {
  Arm arm(0.3);
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(numberOf(Verdict::kClear)), 1400);
  EXPECT_GT(arm.limited(), 1400);
}

TEST(TfAllocation, NoneWhileABodyIsNotChecked) {
  Arm arm(1.0, {true, 1});
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(numberOf(Verdict::kNotChecked)), 1400);
  EXPECT_GT(arm.limited(), 1400);
  EXPECT_GT(arm.warned(), 1400);
}

TEST(TfAllocation, NoneWhilePairsWaitForAFrameThatIsSlow) {
  Arm arm(1.0, {false, 3});
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(numberOf(Verdict::kNotChecked)), 700);
  EXPECT_GT(arm.warned(), 700);
}

/// With wrenches, torques, deepest points and what is drawn.
TEST(TfAllocation, NoneForAGripperInContactWithASlidingFinger) {
  Gripper gripper;
  EXPECT_EQ(steadyAllocations(gripper), 0);
  EXPECT_GT(gripper.contacts(), 1400);
  EXPECT_GT(gripper.measuredTorques(), 1000);
}

}  // namespace sdf_ccd::tf_allocation_test
