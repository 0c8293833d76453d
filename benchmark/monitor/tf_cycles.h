#pragma once

#include <memory>
#include <vector>

#include "monitor/box_world.h"
#include "ros/bag/joint_frames.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/ContactArray.h"

namespace sdf_ccd::benchmark {

/// The monitor as its nodelet runs it, without a ROS master: from the transforms that robot_state_publisher sends for a
/// robot that moves to the serialised message about its contacts.
class TfCycles {
 public:
  /// @param period  between two messages of transforms, each the begin of a cycle [s].
  TfCycles(const Robot& robot, const BoxWorld& world, std::shared_ptr<const Scene> scene, const MonitorOptions& options,
           double period);

  /// Makes the transforms that end cycle `i` of the motion, stamped behind all that were before.
  void prepare(std::size_t i);

  /// Takes the transforms, runs a cycle and makes its message.
  void run();

  /// What of that the monitor itself took, from poses to its result [s]; 0 if there was no cycle.
  double monitorSeconds() const { return monitor_seconds_; }

  std::size_t transformsPerMessage() const { return message_.transforms.size(); }

 private:
  const BoxWorld& world_;
  double period_;
  JointFrames joints_;
  std::unique_ptr<MonitorLoop> loop_;
  sensor_msgs::JointState positions_;
  ros::Time now_;
  tf2_msgs::TFMessage message_;
  ContactArray contacts_;
  double monitor_seconds_ = 0.0;
};

}  // namespace sdf_ccd::benchmark
