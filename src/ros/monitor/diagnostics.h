#pragma once

#include <limits>
#include <string>

#include <diagnostic_updater/diagnostic_updater.h>
#include <diagnostic_updater/update_functions.h>

#include "ros/monitor/monitor_health.h"

namespace sdf_ccd {

/// Publishes:
///   /diagnostics  diagnostic_msgs/DiagnosticArray  once a second: cycles, transforms, bodies, and, once there are
///                                                  cycles, their rate
class Diagnostics {
 public:
  Diagnostics(const ros::NodeHandle& node, const ros::NodeHandle& private_node, const std::string& name);

  /// Publishes if a second has passed, or `at_once`, for example after the clock has jumped. If the clock is set by
  /// more than 2^31 s, diagnostic_updater throws: measuring the rate then starts again.
  void update(const MonitorHealth& health, bool at_once = false);

  /// To be called at the start of each cycle, whether or not there is anything to check.
  void tick();

 private:
  void cycles(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void transforms(diagnostic_updater::DiagnosticStatusWrapper& status) const;
  void bodies(diagnostic_updater::DiagnosticStatusWrapper& status) const;

  diagnostic_updater::Updater updater_;
  MonitorHealth health_;
  double least_rate_ = 0.0, largest_rate_ = std::numeric_limits<double>::infinity();  // [Hz]
  diagnostic_updater::FrequencyStatus rate_;
  bool ticks_ = false;
};

}  // namespace sdf_ccd
