#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <sensor_msgs/JointState.h>

#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// Counts positions in joint states that are not finite, of the robot's joints, and messages about them that do not
/// give a position per name: whoever makes transforms of them makes some that say nothing, or none, and it is the joint
/// that has to be found. Thread-safe.
class JointWatch {
 public:
  explicit JointWatch(const RobotModel& robot);

  void add(const sensor_msgs::JointState& joints);

  /// "60 positions of joint elbow in joint_states are not finite", per joint, and "30 messages of joint_states do not
  /// give a position per name"; `topic` is named as given.
  std::vector<std::string> lines(const std::string& topic) const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::size_t> counts_;  // of all joints of the robot
  std::size_t incomplete_ = 0;                 // messages
};

}  // namespace sdf_ccd
