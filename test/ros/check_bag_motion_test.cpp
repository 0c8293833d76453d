// What the robot is followed by, and when its transforms come.
#include <tf2_msgs/TFMessage.h>

#include <algorithm>

#include <rosbag/view.h>

#include "ros/check_bag_case.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::check_bag_motion_test {

using namespace test;

TEST_F(CheckBag, TfOfTheBaseGoesWithJointStates) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  {
    rosbag::Bag bag(path("arm.bag").string(), rosbag::bagmode::Append);
    for (double time = kBegin; time < kBegin + 2.0; time += kSamplePeriod)
      bag.write("/tf", ros::Time(time), message({stampedTransform("/odom", "/base", time, 0.0)}));
    bag.write("/controller/joint_states", ros::Time(kBegin), sensor_msgs::JointState());  // of another robot
  }
  write("odom.yaml", readText(path("arm.yaml")) + "fixed_frame: odom\n");
  const ToolRun result = run(check("arm.bag", "odom", "--config odom.yaml"));
  EXPECT_EQ(result.exit_code, kPartlyDone);  // the joint states end half a second before the base's transforms
  EXPECT_NE(result.error.find("pairs were not checked for a part of the time, "), std::string::npos) << result.error;
  EXPECT_NE(result.error.find(" for 0.57 of 2.00 s"), std::string::npos) << result.error;
  EXPECT_NE(result.out.find("followed by joint_states"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("fixed frame odom"), std::string::npos) << result.out;
  Row still = table("made/contacts.csv").at(0), moved = table("odom/contacts.csv").at(0);
  EXPECT_NEAR(std::stod(still["start"]), std::stod(moved["start"]), 1e-6);
  EXPECT_EQ(still["depth"], moved["depth"]);
  expectRefused(check("arm.bag", "no", "--joint-states /nowhere"), "contains no joint states on /nowhere");
}

/// As `rosbag record /joint_states /tf_static` has it.
TEST_F(CheckBag, JointStatesCountThoughTfHasTheFixedLinks) {
  {
    rosbag::Bag bag(path("arm.bag").string(), rosbag::bagmode::Append);
    bag.write("/tf_static", ros::Time(kBegin), message({stampedTransform("hand", "tip", kBegin, 0.192)}));
  }
  const ToolRun result = run(check("arm.bag", "made"));
  EXPECT_EQ(result.exit_code, kDone) << result.error;
  EXPECT_NE(result.out.find("followed by joint_states"), std::string::npos) << result.out;
}

TEST_F(CheckBag, TransformsThatComeLateAreNamed) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  {
    rosbag::Bag bag(path("made/checked.bag").string(), rosbag::bagmode::Append);
    const auto late =
        stampedTransform("base", "turret", kBegin + 10.5 * kSamplePeriod, 0.0, M_PI);  // far from its pose
    bag.write("/tf", ros::Time(kBegin + 13.2 * kSamplePeriod), message({late}));
  }
  const ToolRun result = run(check("made/checked.bag", "again"));
  EXPECT_NE(result.out.find("late transforms  in 1 cycles"), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("frames: turret"), std::string::npos) << result.out;
  int contradicting = 0;
  for (Row cycle : table("again/cycles.csv")) {
    if (cycle["contradicted_since"] == "0.000000000") continue;
    ++contradicting;
    EXPECT_NEAR(std::stod(cycle["contradicted_since"]), kBegin + 10.0 * kSamplePeriod, 1e-6);
  }
  EXPECT_EQ(contradicting, 1);
}

/// As by a robot whose computer's clock is ahead of that of the one that records.
TEST_F(CheckBag, TransformsStampedAheadOfTheBagsClockAreChecked) {
  ASSERT_EQ(run(check("arm.bag", "made")).exit_code, kDone);
  ros::Time last;
  {
    const rosbag::Bag made(path("made/checked.bag").string(), rosbag::bagmode::Read);
    rosbag::Bag ahead(path("ahead.bag").string(), rosbag::bagmode::Write);
    for (const rosbag::MessageInstance& message : rosbag::View(made)) {
      const auto transforms = message.instantiate<tf2_msgs::TFMessage>();
      if (!transforms || transforms->transforms.empty()) continue;
      ahead.write(message.getTopic(), std::max(ros::Time(kBegin), message.getTime() - ros::Duration(0.4)), *transforms);
      last = std::max(last, transforms->transforms[0].header.stamp);
    }
  }
  const ToolRun result = run(check("ahead.bag", "again"));
  const std::vector<Row> before = table("made/contacts.csv"), after = table("again/contacts.csv");
  ASSERT_EQ(after.size(), before.size()) << result.out << result.error;
  for (std::size_t k = 0; k < after.size(); ++k)
    EXPECT_NEAR(std::stod(Row(after[k])["start"]), std::stod(Row(before[k])["start"]), 1e-6);
  EXPECT_NEAR(std::stod(Row(table("again/cycles.csv").back())["t1"]), last.toSec(), 1e-6);
}

/// As of a robot that only stands there: nothing else tells where its links are.
TEST_F(CheckBag, StaticTransformsAloneAreChecked) {
  write("still.urdf", R"(<robot name="still">
    <link name="base"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <link name="free"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
    <joint name="j" type="floating"><parent link="base"/><child link="free"/></joint></robot>)");
  write("still.yaml", "check_adjacent: true\ncache: false\n");
  for (const int messages : {1, 2, 31}) {
    {
      rosbag::Bag bag(path("still.bag").string(), rosbag::bagmode::Write);
      for (int i = 0; i < messages; ++i)
        bag.write("/tf_static", ros::Time(kBegin + 0.1 * i), message({stampedTransform("base", "free", kBegin, 0.15)}));
    }
    const ToolRun result = run("check-bag still.bag --urdf still.urdf --config still.yaml --out still");
    ASSERT_EQ(result.exit_code, kDone) << result.error;
    const std::vector<Row> cycles = table("still/cycles.csv");
    ASSERT_FALSE(cycles.empty());
    for (Row cycle : cycles) EXPECT_EQ(cycle["verdict"], "CONTACT");
    constexpr double kPeriod = 1.0 / 30.0;  // by default
    EXPECT_LE(std::stod(Row(cycles.back())["t1"]), kBegin + 0.1 * (messages - 1) + kPeriod + 1e-6);
    EXPECT_NEAR(double(cycles.size()), std::max(1.0, 0.1 * (messages - 1) / kPeriod), 2.0);
  }
}

}  // namespace sdf_ccd::check_bag_motion_test
