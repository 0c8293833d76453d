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

/// The pairs of the scene with these indices, in their order; otherwise as verdictsOf().
std::vector<PairAtRest> pairsIn(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const JointPositions& state);

/// Whether pairs touch in states at rest, parallel over the states; UNCERTAIN also for pairs that are CLEAR but closer
/// than the scene's bound, because states between these may touch.
/// @param pairs   of the scene's links, by index; a link's body has its name, and its frame.
/// @return verdicts per state, each in the order of the pairs.
std::vector<Verdict> verdictsOf(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const std::vector<JointPositions>& states);

}  // namespace sdf_ccd
