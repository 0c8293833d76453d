#pragma once

#include <string>
#include <vector>

#include <ros/time.h>

#include "ros/monitor/diagnostics.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Follows what goes wrong from cycle to cycle, for the diagnostics, and says it in the log: what lasts now and then,
/// the rest once.
class HealthWatch {
 public:
  MonitorHealth& health() { return health_; }
  const MonitorHealth& health() const { return health_; }

  /// What the scene's preparation found: bodies that cannot be checked, warnings, pairs.
  void takeScene(const Scene& scene, const DescribedScene& described, const MonitorParameters& parameters);

  /// What the loop's last cycle found. @param state  of that cycle.
  void takeCycle(const MonitorLoop& loop, const MonitorState& state, const ros::Time& sent);

  /// Cycles run that begin without a frame that they are to wait for, CycleTrigger::awaitedFrame(), or empty.
  void takeTrigger(const std::string& awaited_frame);

  /// No transforms arrive, or no clock by which they could be new.
  void takeStall(const MonitorLoop& loop, const std::string& reason);

  /// The cycles begin anew.
  void forget();

 private:
  void warn(const std::string& warning);
  void measureRate(const ros::WallTime& now);
  void watchFixedFrame(const MonitorLoop& loop, const ros::WallTime& now);
  void watchUnchecked(const std::string& cause, const std::string& besides);
  void watchLate(const MonitorLoop& loop, const ros::WallTime& now);

  MonitorHealth health_;
  ros::WallTime last_cycle_;                      // when it was published; 0 before the first one
  ros::WallTime last_late_;                       // when transforms contradicted a cycle
  ros::WallTime last_frame_check_;                // whether the fixed frame moves
  ros::WallTime awaited_since_;                   // a frame of the trigger; 0: none
  ros::WallTime unchecked_since_, last_warning_;  // 0: all is checked; none was given
};

}  // namespace sdf_ccd
