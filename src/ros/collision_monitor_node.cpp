// The node: loads the nodelet, so that both are the same code.

#include <nodelet/loader.h>
#include <ros/ros.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "collision_monitor");
  nodelet::Loader loader;
  if (!loader.load(ros::this_node::getName(), "sdf_ccd/CollisionMonitor", ros::names::getRemappings(), {})) return 1;
  ros::spin();
}
