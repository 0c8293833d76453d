#pragma once

#include <string>

#include "robot/joint_states.h"

namespace sdf_ccd {

/// The successive joint positions in a bag's joint states. Joints that a message does not name keep their last
/// position; names that are not joints of the robot, and positions that are not finite, are ignored. Messages that
/// change nothing are left out.
/// @param topic  of the joint states; empty: all topics.
/// @throws std::runtime_error that names the bag, if it cannot be read or contains none of the robot's joints.
JointStates recordedPositions(const std::string& bag, const RobotModel& robot, const std::string& topic = {});

}  // namespace sdf_ccd
