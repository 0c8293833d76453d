#include "ros/bag/simulation_bag.h"

#include <gtest/gtest.h>
#include <tf2_msgs/TFMessage.h>

#include <map>

#include <rosbag/view.h>

#include "oracle/files.h"

namespace sdf_ccd::simulation_bag_test {

TEST(SimulationBag, HoldsEveryBodysPosesAndMarkersLockedToThem) {
  const SimulationSetup setup = parseSimulation(
      "step: 0.01\nduration: 1\norigin: [1.0e+6, 0, 0]\nshapes: {ball: {type: sphere, radius: 0.1}, ground: {type: "
      "plane}}\n"
      "bodies: [{name: ground, shape: ground, fixed: true}, {name: ball, shape: ball, xyz: [0.5, 0, 0.25]}]",
      ".");
  const test::TemporaryDirectory directory;
  const std::string path = (directory / "simulation.bag").string();
  {
    BagWriter writer(path, path);
    SimulationBag bag(writer, setup);
    for (int frame = 0; frame < 30; ++frame) bag.add(0.1 * frame, setup.states);
  }
  std::map<std::string, int> counts;
  rosbag::Bag bag(path);
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    ++counts[message.getTopic()];
    EXPECT_GE(message.getTime().toSec(), 1.0);
    if (const auto tf = message.instantiate<tf2_msgs::TFMessage>()) {
      const geometry_msgs::TransformStamped& last = tf->transforms.back();
      const bool is_static = message.getTopic() == "/tf_static";
      EXPECT_EQ(last.header.frame_id, is_static ? "world" : "scene");
      EXPECT_EQ(last.child_frame_id, is_static ? "scene" : "ball");
      EXPECT_EQ(last.transform.translation.x, is_static ? 1e6 : 0.5);
    }
    if (const auto markers = message.instantiate<visualization_msgs::MarkerArray>()) {
      ASSERT_EQ(markers->markers.size(), 2u);
      EXPECT_TRUE(markers->markers[1].frame_locked);
      EXPECT_EQ(markers->markers[1].header.stamp, ros::Time(0));
      EXPECT_EQ(markers->markers[1].header.frame_id, "ball");
      EXPECT_FALSE(markers->markers[1].points.empty());
    }
  }
  EXPECT_EQ(counts["/tf"], 30);
  EXPECT_EQ(counts["/tf_static"], 1);
  EXPECT_EQ(counts["/simulation/bodies"], 8);  // at 0, 0.1 … 0.5, 1.5 and 2.5 s
  bag.close();
}

}  // namespace sdf_ccd::simulation_bag_test
