// The node: loads the nodelet, so that both run the same code.

#include <clocale>
#include <csignal>

#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

namespace {

constexpr double kPeriod = 0.05;  // [s]

volatile std::sig_atomic_t shutdown_requested = 0;

void requestShutdown(int) {
  shutdown_requested = 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::setlocale(LC_CTYPE, "C.UTF-8");  // log4cxx writes names that are not ASCII as ?? in the C locale
  // roscpp's handler would close the connections before the nodelet can publish its last state.
  ros::init(argc, argv, "collision_monitor", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, requestShutdown);
  std::signal(SIGTERM, requestShutdown);
  nodelet::Loader loader(false);  // without services to load or unload nodelets
  if (!loader.load(ros::this_node::getName(), "sdf_ccd/CollisionMonitor", ros::names::getRemappings(), {})) return 1;
  while (ros::ok() && !shutdown_requested) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPeriod));
}
