#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <sensor_msgs/JointState.h>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// Counts the positions of the robot's joints in joint states that are not finite, and the messages that do not give
/// one position per name. From such a message a publisher of transforms makes invalid transforms or none; the counts
/// name the joint at fault. Thread-safe.
class JointWatch {
 public:
  explicit JointWatch(const RobotModel& robot);

  void add(const sensor_msgs::JointState& joints);

  /// One line per joint, "60 positions of joint elbow in joint_states are not finite", and "30 messages of joint_states
  /// do not give a position per name"; `topic` is printed as given.
  std::vector<std::string> lines(const std::string& topic) const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::size_t> counts_;  // per joint of the robot
  std::size_t incomplete_ = 0;                 // messages
};

}  // namespace sdf_ccd
