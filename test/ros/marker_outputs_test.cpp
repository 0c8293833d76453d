// What MarkerOutputs shows when the monitor ends while drawings wait.
#include "ros/monitor/marker_outputs.h"

#include <gtest/gtest.h>

#include <mutex>
#include <thread>

#include <ros/ros.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/loop_case.h"

namespace sdf_ccd::marker_outputs_test {

using namespace test;

class MarkerOutputsTest : public MonitorLoopTest {};

/// Drawing takes longer than handing over: the first drawings are still being drawn when the monitor ends.
TEST_F(MarkerOutputsTest, TheEndIsShownAlthoughDrawingsWait) {
  ros::NodeHandle node("~");
  std::mutex mutex;
  std::string last;
  const boost::function<void(const visualization_msgs::MarkerArray::ConstPtr&)> keep =
      [&](const visualization_msgs::MarkerArray::ConstPtr& markers) {
        const std::lock_guard<std::mutex> lock(mutex);
        for (const auto& marker : markers->markers)
          if (marker.type == visualization_msgs::Marker::TEXT_VIEW_FACING && !marker.text.empty()) last = marker.text;
      };
  int lost = 0;
  for (int trial = 0; trial < 20; ++trial) {
    begin();
    MarkerOutputs outputs(node, node.advertise<visualization_msgs::MarkerArray>("world", 1, true), *loop_, {});
    const ros::Subscriber subscriber = node.subscribe<visualization_msgs::MarkerArray>("markers", 100, keep);
    ros::AsyncSpinner spinner(1);
    spinner.start();
    for (int i = 0; i < 200 && !outputs.wantsMarkers(); ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      outputs.countSubscribers();
    }
    ASSERT_TRUE(outputs.wantsMarkers());
    for (int i = 0; i < 3; ++i) {
      sendHand(10 + kPeriod * i, 0.5);
      sendFoot(10 + kPeriod * i);
      step(10 + kPeriod * i);
    }
    ASSERT_FALSE(said_.empty());
    for (int i = 0; i < 4; ++i) outputs.draw();
    outputs.drawUnchecked("the monitor has ended");
    outputs.finish();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::lock_guard<std::mutex> lock(mutex);
    lost += last.find("the monitor has ended") == std::string::npos;
    last.clear();
  }
  EXPECT_EQ(lost, 0);
}

}  // namespace sdf_ccd::marker_outputs_test

int main(int argc, char** argv) {
  ros::init(argc, argv, "marker_outputs_test");
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
