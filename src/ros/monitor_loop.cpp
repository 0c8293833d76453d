#include "ros/monitor_loop.h"

namespace sdf_ccd {

MonitorLoop::MonitorLoop(std::shared_ptr<const Scene> scene, const std::string& fixed_frame,
                         const MonitorParameters& parameters)
    : history_(fixed_frame),
      tracker_(history_, trackedBodies(*scene), scene->pairs, parameters.tf),
      monitor_(scene, parameters.monitor) {}

TfTracker::Step MonitorLoop::step(const ros::Time& now, const CycleRequest& request) {
  const TfTracker::Step step = tracker_.next(now, cycle_);
  if (step == TfTracker::Step::kJump) monitor_.reset();
  if (step == TfTracker::Step::kCycle) result_ = &monitor_.run(cycle_.motion, request);
  return step;
}

void MonitorLoop::reset() {
  tracker_.reset();
  monitor_.reset();
}

}  // namespace sdf_ccd
