#pragma once

#include <string>
#include <vector>

#include <ros/time.h>

#include "monitor/cycle_safety.h"
#include "ros/monitor/diagnostics.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Follows problems from cycle to cycle, for the diagnostics, and logs them: lasting ones at intervals, others once.
class HealthWatch {
 public:
  MonitorHealth& health() { return health_; }
  const MonitorHealth& health() const { return health_; }

  /// Records the problems found while the scene was prepared: bodies that cannot be checked, warnings, pairs.
  void recordScene(const Scene& scene, const DescribedScene& described, const MonitorParameters& parameters);

  /// Records the results of the loop's last cycle. @param state, safety  of that cycle.
  void recordCycle(const MonitorLoop& loop, const MonitorState& state, const CycleSafety& safety,
                   const ros::Time& sent);

  /// Records the frame that the trigger waits for in vain: CycleTrigger::awaitedFrame(), or empty.
  void recordTrigger(const std::string& awaited_frame);

  /// Records the reason why no cycle runs: no transforms arrive, or the clock does not run.
  void recordStall(const MonitorLoop& loop, const std::string& reason);

  /// To be called when cycles start again, after a reset or a jump of time.
  void restart();

 private:
  void warn(const std::string& warning);
  void countPairs(const Scene& scene);
  void watchStanding(const StandingWarnings& warnings);
  void measureRate(const ros::WallTime& now);
  void watchUnchecked(const MonitorLoop& loop, const std::string& cause, const std::string& other);
  void watchLate(const MonitorLoop& loop, const ros::WallTime& now);

  MonitorHealth health_;
  std::vector<std::string> standing_;             // warnings as last read
  ros::WallTime last_cycle_;                      // 0 before the first one
  ros::WallTime last_late_;                       // when transforms last contradicted a cycle
  ros::WallTime awaited_since_;                   // when a frame of the trigger was first missed; 0: none is
  std::string awaited_frame_;                     // the frame that was warned about; empty: none
  ros::WallTime unchecked_since_, last_warning_;  // 0: everything is checked; no warning was given
};

}  // namespace sdf_ccd
