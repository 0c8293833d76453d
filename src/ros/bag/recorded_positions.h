#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// The joint positions of a bag's joint states, one after the other. What a message does not name stays as the last one
/// said; joints that are not the robot's, and positions that are not finite, are passed over. Messages that change
/// nothing are left out.
/// @param topic  of joint states; empty: all of the bag.
/// @throws std::runtime_error that names the bag, if it cannot be read, or says nothing of the robot's joints.
std::vector<JointPositions> recordedPositions(const std::string& bag, const RobotModel& robot,
                                              const std::string& topic = {});

}  // namespace sdf_ccd
