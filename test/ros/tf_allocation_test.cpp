// From transforms to the message about contacts, nothing is allocated once the history holds all that it keeps.

#include <gtest/gtest.h>

#include "allocations.h"
#include "oracle/scene_case.h"
#include "ros/described_world.h"
#include "ros/messages/message_pool.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd {
namespace {

using test::stampedTransform;

constexpr int kLinks = 10;
constexpr double kPeriod = 0.01;  // [s]

/// An arm of balls that bends back and forth above a ground, between a static base and a static tool.
class Arm {
 public:
  explicit Arm(double height) {
    std::vector<BodyDescription> bodies = {test::body("ground", test::ground(), true)};
    for (int link = 0; link < kLinks; ++link) bodies.push_back(test::body(name(link), Sphere{0.02}));
    bodies.push_back(test::body("tool", Sphere{0.02}));
    MonitorParameters parameters;
    parameters.monitor = test::soft();
    loop_ = std::make_unique<MonitorLoop>(test::build(bodies), test::describedWorld(), parameters);
    Quaterniond upright = Quaterniond::Identity();
    loop_->history().add(test::message({stampedTransform("/world", "base", ros::Time(), upright, {0.0, 0.0, height}),
                                        stampedTransform(name(kLinks - 1), "tool", 0.0, 0.1)}),
                         true);
    for (int link = 0; link < kLinks; ++link) {
      message_.transforms.push_back(stampedTransform(link == 0 ? "base" : name(link - 1), "/" + name(link), 0.0, 0.1));
    }
  }

  /// One second of motion that ends where it begins.
  void move() {
    for (int i = 0; i < 100; ++i, ++now_) {
      const ros::Time now = ros::Time(100.0) + ros::Duration(kPeriod * now_);
      const double yaw = 0.02 * std::sin(2.0 * M_PI * i / 100.0);
      for (geometry_msgs::TransformStamped& transform : message_.transforms) {
        transform.header.stamp = now;
        transform.transform.rotation.w = std::cos(0.5 * yaw);
        transform.transform.rotation.z = std::sin(0.5 * yaw);
      }
      loop_->history().watchClock(now);
      loop_->history().add(message_, false);
      if (loop_->step(now, {true, 5}) != TfTracker::Step::kCycle) continue;
      const boost::shared_ptr<ContactArray> contacts = contacts_.take();
      setContactArray(*loop_, *contacts);
      const boost::shared_ptr<MonitorState> state = states_.take();
      setMonitorState(*loop_, now, *state);
      loop_->measureDistances(0.5);
      const boost::shared_ptr<DistanceArray> distances = distances_.take();
      setDistanceArray(*loop_, 0.5, *distances);
      EXPECT_FALSE(distances->distances.empty());
      ++cycles_[contacts->verdict];
    }
  }

  int cycles(std::uint8_t verdict) const { return cycles_[verdict]; }

 private:
  static std::string name(int link) { return "a_link_with_a_long_name_" + std::to_string(link); }

  std::unique_ptr<MonitorLoop> loop_;
  tf2_msgs::TFMessage message_;
  MessagePool<ContactArray> contacts_;
  MessagePool<MonitorState> states_;
  MessagePool<DistanceArray> distances_;
  long now_ = 0;
  int cycles_[4] = {0, 0, 0, 0};
};

/// Allocations during the last second, after more seconds than the history keeps.
long steadyAllocations(Arm& arm) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  for (int second = 0; second < 14; ++second) arm.move();
  const long before = test::allocations;
  arm.move();
  return test::allocations - before;
}

TEST(TfAllocation, NoneFromTransformsToTheMessageWhileAllIsClear) {
  Arm arm(1.0);
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(ContactArray::CLEAR), 1400);
}

TEST(TfAllocation, NoneFromTransformsToTheMessageOfContactsLikeTheLast) {
  Arm arm(0.015);
  EXPECT_EQ(steadyAllocations(arm), 0);
  EXPECT_GT(arm.cycles(ContactArray::CONTACT), 1400);
}

}  // namespace
}  // namespace sdf_ccd
