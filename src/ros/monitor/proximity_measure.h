#pragma once

#include <cstdint>
#include <string>

#include "monitor/cycle_safety.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/MonitorState.h"

namespace sdf_ccd {

/// Measures the distances of bodies after each cycle, if they are needed, and judges the cycle, on the ROS clock.
class ProximityMeasure {
 public:
  /// @param loop  whose last cycle is measured; must outlive this.
  ProximityMeasure(const ProximityParameters& parameters, MonitorLoop& loop);

  const ProximityParameters& parameters() const { return parameters_; }

  /// Sets thresholds and distances; whether there is a velocity scale does not change.
  void setParameters(const ProximityParameters& parameters);

  /// Whether something is measured: the cycle must then report the clearances of all pairs.
  /// @param lists_distances  whether pairs within report_distance are wanted.
  bool isNeeded(bool lists_distances) const { return range(lists_distances) > 0.0; }

  /// Measures and judges the loop's last cycle; the distances are in the loop.
  const CycleSafety& measure(bool lists_distances);

  /// While no cycle runs.
  const CycleSafety& noCycle() { return safety_ = judgeNoCycle(rules(), memory_); }

  /// The same, while another thread measures.
  CycleSafety noCycleMeanwhile() const {
    SafetyMemory memory;
    return judgeNoCycle(rules(), memory);
  }

  /// Of the last cycle, or that there is none.
  const CycleSafety& safety() const { return safety_; }

  /// Sets what a state tells of it.
  void setState(const CycleSafety& safety, MonitorState& state) const;

  /// As judged by.
  SafetyRules rules() const;

 private:
  /// Pairs farther apart than this need not be measured [m].
  double range(bool lists_distances) const;

  MonitorLoop& loop_;
  ProximityParameters parameters_;
  std::string promise_text_;
  SafetyMemory memory_;
  std::uint64_t version_ = 0;  // of the scene that was judged last
  CycleSafety safety_;
};

}  // namespace sdf_ccd
