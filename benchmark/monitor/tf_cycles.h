#pragma once

#include <memory>
#include <vector>

#include "monitor/box_world.h"
#include "ros/bag/joint_frames.h"
#include "ros/monitor/monitor_loop.h"
#include "sdf_ccd/ContactArray.h"

namespace sdf_ccd::benchmark {

/// The monitor as its nodelet runs it, without a ROS master: from the transforms that robot_state_publisher sends for a
/// moving robot to the serialised message of its contacts.
class TfCycles {
 public:
  /// @param period  time between two messages of transforms, each of which begins a cycle [s].
  TfCycles(const Robot& robot, const BoxWorld& world, std::shared_ptr<const Scene> scene, const MonitorOptions& options,
           double period);

  /// Prepares the transforms at the end of cycle `i` of the motion, stamped later than all previous ones.
  void prepare(std::size_t i);

  /// Adds the prepared transforms, runs a cycle and serialises its message.
  void run();

  /// Part of run() that the monitor itself took, from poses to its result [s]; 0 if no cycle was run.
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
