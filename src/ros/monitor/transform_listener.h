#pragma once

#include <memory>

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_msgs/TFMessage.h>

#include "ros/monitor/diagnostics.h"
#include "ros/tf/cycle_trigger.h"
#include "ros/tf/joint_watch.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

/// Receives transforms and joint states in a thread of its own: transforms are added to the history, and both may
/// trigger a cycle.
///
/// Subscribes:
///   /tf, /tf_static  tf2_msgs/TFMessage
///   joint_states     sensor_msgs/JointState  only to report joints whose positions are not finite, and as a trigger
class TransformListener {
 public:
  TransformListener(const ros::NodeHandle& node, const RobotModel& robot, TfHistory& history, CycleTrigger& trigger);
  ~TransformListener();

  /// Subscribes to /tf_static again, at most every two seconds, if static transforms that are needed now were dropped
  /// before: publishers send all of them to a new subscriber.
  void recoverStatic();

  /// Sets the problems of received messages, and logs at intervals what was dropped since the last call.
  void report(MonitorHealth& health);

 private:
  ros::Subscriber subscribe(const std::string& tf_topic, bool is_static);
  void receive(const tf2_msgs::TFMessage& message, bool is_static);

  ros::NodeHandle node_;
  ros::CallbackQueue queue_;
  TfHistory& history_;
  CycleTrigger& trigger_;
  JointWatch joint_watch_;
  ros::WallTime last_static_;  // when /tf_static was last subscribed to
  ros::Subscriber tf_, tf_static_, joint_states_;
  std::unique_ptr<ros::AsyncSpinner> spinner_;
};

}  // namespace sdf_ccd
