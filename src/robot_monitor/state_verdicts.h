#pragma once

#include <vector>

#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// A pair in one state of the robot.
struct PairAtRest {
  Verdict verdict = Verdict::kNotChecked;
  double depth = 0.0;  ///< of the deepest point found, if they are in contact [m]
};

/// Of pairs of the scene, by index, in their order; all else as for verdictsOf().
std::vector<PairAtRest> pairsIn(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const JointPositions& state);

/// Whether pairs touch in states at rest, in parallel over the states; UNCERTAIN also where they are CLEAR, but nearer
/// than the scene's bound, as states between these may be.
/// @param pairs   of the scene's links, by index; a link's body has its name, and its frame.
/// @return one after the other per state, in the pairs' order.
std::vector<Verdict> verdictsOf(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const std::vector<JointPositions>& states);

}  // namespace sdf_ccd
