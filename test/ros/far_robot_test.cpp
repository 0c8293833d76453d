// A robot kilometres away from the origin of its map, whose base is the fixed frame: when it turns there, the map's
// origin moves at thousands of metres per second.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "oracle/scene_case.h"
#include "ros/described_world.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::far_robot_test {

using namespace test;

constexpr double kFar = 3000.0;   // of the robot from the map's origin [m]
constexpr double kArm = 1.0;      // its length [m]
constexpr double kPeriod = 0.05;  // [s]
constexpr double kSpeed = 2.0;    // at which it turns [rad/s]: 6000 m/s and 300 m per cycle at the map's origin

/// The arm reaches forward, 0.5 m above the ground. A post stands 1 m to its left.
std::shared_ptr<const Scene> scene() {
  BodyDescription arm = body("arm", Box::fromSize({kArm, 0.04, 0.04}));
  arm.frame = "base";
  arm.geometry[0].X_BG = translation({0.5 * kArm, 0, 0.5});
  BodyDescription plane = body("ground", ground(), true);
  BodyDescription post = body("post", Cylinder::fromRadiusAndLength(0.02, 1.0), true);
  post.geometry[0].X_BG = translation({kFar, 0.9 * kArm, 0.5});  // as a mesh in coordinates of the map
  BodyDescription table = body("table", Box::fromSize({0.2, 0.2, 0.2}), true);
  table.X_frame_B = translation({kFar, -3.0, 0.5});
  BodyDescription tower = body("tower", Box::fromSize({2.0, 2.0, 2.0}), true);  // at the origin
  for (BodyDescription* object : {&plane, &post, &table, &tower}) object->frame = "map";
  return build({arm, plane, post, table, tower});
}

class FarRobot : public ::testing::Test {
 protected:
  void begin(const std::string& fixed_frame) {
    DescribedScene described;
    described.fixed_frame = fixed_frame;
    MonitorParameters parameters;
    parameters.monitor = soft();
    parameters.tf.max_latency = 0.5;
    parameters.tf.max_cycle = 1.0;
    loop_ = std::make_unique<MonitorLoop>(scene(), described, parameters);
    time_ = 10.0;
  }

  /// Whether a cycle ends with it.
  bool send(double yaw, double x = kFar) {
    time_ += kPeriod;
    loop_->history().add(message({stampedTransform("map", "base", time_, x, yaw)}), false);
    return loop_->step(ros::Time(time_), {}) == TfTracker::Step::kCycle;
  }

  std::unique_ptr<MonitorLoop> loop_;
  double time_ = 0.0;
};

class FarRobotIn : public FarRobot, public ::testing::WithParamInterface<const char*> {};

TEST_P(FarRobotIn, IsCheckedWhileItTurns) {
  begin(GetParam());
  int cycles = 0;
  double yaw = 0.0, first_contact = 0.0;
  for (; yaw < 0.6 * M_PI; yaw += kSpeed * kPeriod) {
    if (!send(yaw)) continue;
    ++cycles;
    const CycleResult& result = loop_->result();
    ASSERT_EQ(result.not_checked, 0) << yaw << ": " << toContactArray(*loop_).reason;
    for (const PairResult& pair : result.pairs)
      if (pair.verdict == Verdict::kContact && first_contact == 0.0)
        first_contact = yaw - kSpeed * (kPeriod - pair.intervals.front().enter);
  }
  EXPECT_GT(cycles, 10);
  const double touch = 0.5 * M_PI - std::asin(0.04 / (0.9 * kArm));  // the arm's side at the post
  EXPECT_NEAR(first_contact, touch, 5e-3);
}

TEST_P(FarRobotIn, IsNotCheckedWhereItsMapJumps) {
  begin(GetParam());
  for (int i = 0; i < 5; ++i) send(0.0);
  ASSERT_EQ(loop_->result().verdict, Verdict::kClear);
  ASSERT_TRUE(send(0.0, kFar + 500.0));
  EXPECT_EQ(loop_->result().verdict, Verdict::kNotChecked);
  EXPECT_NE(toContactArray(*loop_).reason.find("has jumped by 500 m"), std::string::npos)
      << toContactArray(*loop_).reason;
  ASSERT_TRUE(send(0.0, kFar + 500.0));
  EXPECT_EQ(loop_->result().verdict, Verdict::kClear);
}

INSTANTIATE_TEST_SUITE_P(FixedFrame, FarRobotIn, ::testing::Values("base", "map"));

}  // namespace sdf_ccd::far_robot_test
