#pragma once

#include "ros/conversions.h"
#include "ros/monitor_loop.h"

namespace sdf_ccd {

/// What is to be drawn of a cycle, while the loop goes on with the next one.
class CycleSnapshot {
 public:
  /// Of the loop's last cycle. Of pairs that do not touch only verdict, reason, span and clearance. Memory is used
  /// again.
  void take(const MonitorLoop& loop);

  const CycleResult& result() const { return result_; }
  CycleContext context() const { return {*scene_, motion_, samples_, origin_}; }

 private:
  const Scene* scene_ = nullptr;
  CycleResult result_;
  CycleMotion motion_;
  std::vector<double> samples_;
  ros::Time origin_;
};

}  // namespace sdf_ccd
