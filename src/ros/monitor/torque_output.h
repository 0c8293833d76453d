#pragma once

#include <string>
#include <vector>

#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <sensor_msgs/JointState.h>
#include <boost/shared_ptr.hpp>

#include "robot_monitor/contact_torques.h"
#include "ros/messages/message_pool.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd {

/// Publishes the forces and torques of the contact wrenches at the robot's joints.
///
/// Publishes, below the node's name:
///   joint_torques  sensor_msgs/JointState  every cycle: effort is the generalised force of all contacts, averaged over
///                                          the time checked [N·m, N]; NaN where tf has no transform of the
///                                          joint in the cycle
class TorqueOutput {
 public:
  explicit TorqueOutput(const DescribedScene& described);

  /// Per body: index of the robot's link that carries it; −1: none.
  std::vector<int> linksOf(const Scene& scene) const;

  /// To be called before set(), and between two cycles when the scene changes.
  void swapLinks(std::vector<int>& links) { torques_.swapLinks(links); }

  void advertise(ros::NodeHandle private_node);

  bool isWanted() const { return publisher_.getNumSubscribers() > 0; }

  /// The message about the loop's last cycle, which must have been requested with wrenches.
  boost::shared_ptr<sensor_msgs::JointState> toMessage(MonitorLoop& loop);
  void set(MonitorLoop& loop, sensor_msgs::JointState& message);

  void publish(const boost::shared_ptr<sensor_msgs::JointState>& message) { publisher_.publish(message); }

 private:
  void findLinks(const TfHistory& history, const TrackedCycle& cycle);

  ContactTorques torques_;
  std::vector<std::string> frames_;  // per link
  ros::Publisher publisher_;
  MessagePool<sensor_msgs::JointState> messages_;

  // Of the links that the torques need.
  TfChains chains_;
  std::vector<TfSpan> spans_;
  std::vector<TimePart> parts_;
  TfWindow window_;
};

}  // namespace sdf_ccd
