#pragma once

#include "ros/messages/conversions.h"
#include "ros/monitor/monitor_loop.h"

namespace sdf_ccd {

/// What is to be drawn of a cycle, while the loop goes on with the next one.
class CycleSnapshot {
 public:
  /// Of the loop's last cycle. Of pairs that do not touch only verdict, reason, span and clearance. Memory is used
  /// again.
  void take(const MonitorLoop& loop);

  /// Gives back the world.
  void release() { world_.reset(); }

  const CycleResult& result() const { return result_; }
  CycleContext context() const { return {world_->scene(), motion_, samples_, origin_}; }

 private:
  std::shared_ptr<const CheckedWorld> world_;
  CycleResult result_;
  CycleMotion motion_;
  std::vector<double> samples_;
  ros::Time origin_;
};

}  // namespace sdf_ccd
