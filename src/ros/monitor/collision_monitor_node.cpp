// The node: loads the nodelet, so that both run the same code.

#include <csignal>

#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

namespace {

constexpr double kPeriod = 0.05;  // [s]

volatile std::sig_atomic_t is_asked_to_end = 0;

void askToEnd(int) {
  is_asked_to_end = 1;
}

}  // namespace

int main(int argc, char** argv) {
  // roscpp's handler would close the connections before the nodelet can report that it ends.
  ros::init(argc, argv, "collision_monitor", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, askToEnd);
  std::signal(SIGTERM, askToEnd);
  nodelet::Loader loader(false);  // without services to load or unload nodelets
  if (!loader.load(ros::this_node::getName(), "sdf_ccd/CollisionMonitor", ros::names::getRemappings(), {})) return 1;
  while (ros::ok() && !is_asked_to_end) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPeriod));
}
