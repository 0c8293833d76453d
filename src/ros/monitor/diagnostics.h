#pragma once

#include <limits>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>

#include "ros/monitor/monitor_health.h"
#include "ros/monitor/ordered_worker.h"

namespace sdf_ccd {

/// Publishes:
///   /diagnostics  diagnostic_msgs/DiagnosticArray  once a second: cycles, transforms, bodies, and, once there are
///                                                  cycles, their rate
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name);

  /// Publishes if a second has passed on the ROS clock, or `at_once`, for example after it has jumped. If it is set by
  /// more than 2^31 s, diagnostic_updater throws: measuring the rate then starts again.
  void update(const MonitorHealth& health, bool at_once = false);

  /// To be called at the start of each cycle, whether or not there is anything to check.
  void tick();

 private:
  struct Report {
    MonitorHealth health;
    bool at_once = false;
  };

  void publish(const Report& report);
  void cycles(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void transforms(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void bodies(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  // Used by the thread that publishes.
  diagnostic_updater::Updater updater_;
  MonitorHealth health_;
  double least_rate_ = 0.0, largest_rate_ = std::numeric_limits<double>::infinity();  // [Hz]
  diagnostic_updater::FrequencyStatus rate_;  // may be used by several threads, like the addition to updater_

  bool ticks_ = false;
  bool at_once_ = false;       // requested since the last report
  ros::WallTime reported_at_;  // time of the last report
  OrderedWorker<Report> worker_;
};

}  // namespace sdf_ccd
