#pragma once

#include "ros/bag/recorded_motion.h"
#include "ros/monitor/monitor_loop.h"

namespace sdf_ccd {

/// Receives the results of checkBag(), in the order of the bag's clock.
class BagObserver {
 public:
  virtual ~BagObserver() = default;

  /// Called before any cycle that uses these transforms.
  virtual void onTransforms(const RecordedTransforms& transforms) = 0;

  /// Called after each new cycle of the loop.
  virtual void onCycle(const ros::Time& now) = 0;

  /// Called when nothing is checked after the last cycle from now on: time has jumped, so that earlier results belong
  /// to another time, or no transforms have come for max_latency.
  virtual void onUnchecked(const std::string& reason, const ros::Time& now) = 0;

  /// Called at the end of a part of the bag without cycles: transforms have ended, or were refused. The gap begins at
  /// the end of the last cycle, in the time of the transforms.
  virtual void onGap(const TimePart& gap, const std::string& reason, const ros::Time& now) = 0;
};

/// Runs the monitor's loop over the contents of a bag, as fast as possible. The ROS clock follows the bag, as with
/// `rosbag play --clock`; one cycle is due every 1 / rate of it, as with a live monitor that is never late, and one at
/// the end of the bag.
void checkBag(const RecordedMotion& motion, const MonitorParameters& parameters, MonitorLoop& loop,
              BagObserver& observer);

}  // namespace sdf_ccd
