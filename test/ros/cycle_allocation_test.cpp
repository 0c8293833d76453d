// The thread that runs the nodelet's cycles allocates nothing once they are alike, whatever is subscribed to.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <thread>

#include <geometry_msgs/WrenchStamped.h>
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <tbb/global_control.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/tf_messages.h"
#include "sdf_ccd/ContactArray.h"
#include "sdf_ccd/DistanceArray.h"
#include "sdf_ccd/MonitorState.h"
#include "sdf_ccd/Verdict.h"
#include "thread_allocations.h"

namespace sdf_ccd::cycle_allocation_test {

using test::stampedTransform;

const std::string kName = "/monitor";
constexpr double kPeriod = 0.01;  // of transforms [s]

/// The thread of this process with this name; 0 if there is none.
pid_t threadNamed(const std::string& name) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/task")) {
    std::string found;
    std::getline(std::ifstream(entry.path() / "comm"), found);
    if (found == name) return static_cast<pid_t>(std::stol(entry.path().filename().string()));
  }
  return 0;
}

class CycleAllocationTest : public ::testing::Test {
 protected:
  CycleAllocationTest() {
    subscribe<ContactArray>("contacts", [this](const ContactArray& contacts) {
      contacts_ += contacts.verdict == Verdict::CONTACT && !contacts.pairs.empty();
    });
    subscribe<MonitorState>("state", [](const MonitorState&) {});
    subscribe<DistanceArray>("distances", [](const DistanceArray&) {});
    subscribe<sensor_msgs::JointState>("joint_torques", [](const sensor_msgs::JointState&) {});
    subscribe<geometry_msgs::WrenchStamped>("wrenches/finger", [this](const geometry_msgs::WrenchStamped& wrench) {
      pressed_ += wrench.wrench.force.x < 0.0;
    });
    for (const std::string topic : {"markers", "links", "world"})
      subscribe<visualization_msgs::MarkerArray>(topic, [](const visualization_msgs::MarkerArray&) {});
  }

  template <class Message>
  void subscribe(const std::string& topic, const std::function<void(const Message&)>& take) {
    const boost::function<void(const boost::shared_ptr<const Message>&)> receive =
        [take](const boost::shared_ptr<const Message>& message) { take(*message); };
    subscribers_.push_back(node_.subscribe<Message>(kName + "/" + topic, 100, receive));
  }

  /// Moves the gripper. @param at_once  number of transforms that arrive at a time.
  void move(double seconds, int at_once = 1) {
    const ros::Time begin = ros::Time::now();
    const auto start = std::chrono::steady_clock::now();
    const int count = static_cast<int>(seconds / kPeriod) / at_once * at_once;
    for (int i = 1; i <= count; ++i) {
      const std::chrono::duration<double> due(kPeriod * ((i + at_once - 1) / at_once) * at_once);
      std::this_thread::sleep_until(start + std::chrono::duration_cast<std::chrono::nanoseconds>(due));
      send(begin + ros::Duration(kPeriod * i));
    }
  }

  void send(const ros::Time& stamp) {
    const double swing = std::sin(2.0 * M_PI * std::fmod(stamp.toSec(), 1.0));
    tf_.publish(test::message(
        {stampedTransform("base", "palm", stamp, Quaterniond(Eigen::AngleAxisd(0.01 * swing, Vector3d::UnitZ())),
                          Vector3d::Zero()),
         stampedTransform("palm", "finger", stamp, Quaterniond::Identity(), Vector3d(0.1, 0.01 * swing, 0.0))}));
  }

  ros::NodeHandle node_;
  ros::Publisher tf_ = node_.advertise<tf2_msgs::TFMessage>("/tf", 100);
  std::vector<ros::Subscriber> subscribers_;
  nodelet::Loader loader_{false};
  std::atomic<int> contacts_{0}, pressed_{0};
};

TEST_F(CycleAllocationTest, NoneOnceCyclesAreAlike) {
  // A thread that joins late makes its own scratch memory once, whenever that is.
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  ASSERT_TRUE(loader_.load(kName, "sdf_ccd/CollisionMonitor", {}, {}));
  for (int i = 0; i < 600 && contacts_ == 0; ++i) move(0.1);
  ASSERT_GT(contacts_, 0);
  const pid_t cycles = threadNamed("sdf_ccd cycles");
  ASSERT_NE(cycles, 0);
  move(2.0, 4);  // a busy machine may miss cycles
  move(2.0);
  // Longer than all that the cycles do only now and then.
  constexpr double kSeconds = 3.0;
  constexpr int kTrials = 5;  // a cycle longer than any before it allocates
  std::vector<long> counts;
  for (int trial = 0; trial < kTrials && (counts.empty() || counts.back() > 0); ++trial) {
    const int contacts = contacts_, pressed = pressed_;
    const test::ThreadAllocations allocations(cycles);
    move(kSeconds);
    counts.push_back(allocations.count());
    EXPECT_GT(contacts_, contacts + 30);
    EXPECT_GT(pressed_, pressed + 30);
  }
  EXPECT_EQ(counts.back(), 0) << ::testing::PrintToString(counts);
  EXPECT_TRUE(loader_.unload(kName));
}

}  // namespace sdf_ccd::cycle_allocation_test

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "cycle_allocation_test");
  ros::NodeHandle node;
  ros::AsyncSpinner spinner(1);
  spinner.start();
  return RUN_ALL_TESTS();
}
