#pragma once

#include <string>

#include "robot/joint_states.h"

namespace sdf_ccd {

/// The successive joint positions in a bag's joint states. Joints that a message does not name keep their last
/// position; names that are not joints of the robot are ignored. Messages with a position of the robot's joints that is
/// not finite, and those that change nothing, are left out.
/// @param topic    of the joint states; empty: all topics.
/// @param warning  set if messages with positions that are not finite were left out.
/// @throws std::runtime_error that names the bag, if it cannot be read or no positions of the robot's joints are left.
JointStates recordedPositions(const std::string& bag, const RobotModel& robot, const std::string& topic,
                              std::string& warning);

}  // namespace sdf_ccd
