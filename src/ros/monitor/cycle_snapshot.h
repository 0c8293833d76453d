#pragma once

#include "ros/messages/conversions.h"
#include "ros/monitor/monitor_loop.h"

namespace sdf_ccd {

/// The data of a cycle that are drawn while the loop runs the next one.
class CycleSnapshot {
 public:
  /// Copies the loop's last cycle; of pairs without contact only verdict, reason, span and clearance. Memory is reused.
  void copyFrom(const MonitorLoop& loop);

  /// Releases the world.
  void release() { world_.reset(); }

  const CycleResult& result() const { return result_; }
  CycleContext context() const { return {world_->scene(), motion_, samples_, origin_}; }
  const std::vector<std::string>& warnings() const { return warnings_; }  ///< MonitorLoop::warnings()

 private:
  std::shared_ptr<const CheckedWorld> world_;
  CycleResult result_;
  CycleMotion motion_;
  std::vector<double> samples_;
  ros::Time origin_;
  std::vector<std::string> warnings_;
};

}  // namespace sdf_ccd
