#pragma once

#include "ros/bag/recorded_motion.h"
#include "ros/monitor/monitor_loop.h"

namespace sdf_ccd {

/// Is told of a bag's check, in the order of the bag's clock.
class BagObserver {
 public:
  virtual ~BagObserver() = default;

  /// Before any cycle that uses them.
  virtual void onTransforms(const RecordedTransforms& transforms) = 0;

  /// The loop has a new cycle.
  virtual void onCycle(const ros::Time& now) = 0;

  /// Nothing is checked after the last cycle. Time has jumped, so that what was found before is about another
  /// time, or no transforms have come for max_latency; told when it begins.
  virtual void onUnchecked(const std::string& reason, const ros::Time& now) = 0;

  /// No cycle has been run over a part of the bag, which is over now: transforms have ended, or were refused. By the
  /// clock of the transforms, from the last cycle's end on.
  virtual void onGap(const TimePart& gap, const std::string& reason, const ros::Time& now) = 0;
};

/// Runs the monitor's loop over what a bag recorded, as fast as it goes. The ROS clock is the bag's, as with
/// `rosbag play --clock`; a cycle is due every 1 / rate of it, as with a live monitor that is never late, and one at
/// the bag's end.
void checkBag(const RecordedMotion& motion, const MonitorParameters& parameters, MonitorLoop& loop,
              BagObserver& observer);

}  // namespace sdf_ccd
