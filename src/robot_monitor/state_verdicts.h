#pragma once

#include <vector>

#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// Whether pairs touch in states at rest, in parallel over the states; UNCERTAIN also where they are CLEAR, but nearer
/// than the scene's bound, as states between these may be.
/// @param scene   of the robot's links alone, each in its link's frame.
/// @param pairs   of the scene, by index.
/// @return one after the other per state, in the pairs' order.
std::vector<Verdict> verdictsOf(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const std::vector<JointPositions>& states);

}  // namespace sdf_ccd
