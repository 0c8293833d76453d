// The node: loads the nodelet, so that both run the same code.

#include <malloc.h>

#include <clocale>
#include <csignal>

#include <nodelet/loader.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>

namespace {

constexpr double kPeriod = 0.05;  // [s]

volatile std::sig_atomic_t shutdown_requested = 0;

/// What requests needed is returned to the system. By default each of the threads that answer them has a heap, which
/// keeps twice as much at its end as the largest block freed so far, up to 64 MB.
void keepLittleMemory() {
  mallopt(M_ARENA_MAX, 2);
  mallopt(M_MMAP_THRESHOLD, 256 << 10);  // larger blocks are mapped, and unmapped when they are freed
  mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

void requestShutdown(int) {
  shutdown_requested = 1;
}

}  // namespace

int main(int argc, char** argv) {
  keepLittleMemory();
  std::setlocale(LC_CTYPE, "C.UTF-8");  // log4cxx writes names that are not ASCII as ?? in the C locale
  // roscpp's handler would close the connections before the nodelet can publish its last state.
  ros::init(argc, argv, "collision_monitor", ros::init_options::NoSigintHandler);
  std::signal(SIGINT, requestShutdown);
  std::signal(SIGTERM, requestShutdown);
  nodelet::Loader loader(false);  // without services to load or unload nodelets
  if (!loader.load(ros::this_node::getName(), "sdf_ccd/CollisionMonitor", ros::names::getRemappings(), {})) return 1;
  while (ros::ok() && !shutdown_requested) ros::getGlobalCallbackQueue()->callAvailable(ros::WallDuration(kPeriod));
}
