#pragma once

#include <functional>
#include <vector>

#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// What a pair's result in a state at rest means to who asks.
using Judge = std::function<Verdict(const PairResult&)>;

/// A pair in one state of the robot.
struct PairAtRest {
  Verdict verdict = Verdict::kNotChecked;  ///< as judged
  double depth = 0.0;                      ///< of the deepest point found, if they are in contact [m]
};

/// The pairs of the scene with these indices, in their order; otherwise as verdictsOf().
std::vector<PairAtRest> pairsIn(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const JointPositions& state, const Judge& judge);

/// Pairs in states at rest, parallel over the states.
/// @param pairs   of the scene's links, by index; a link's body has its name, and its frame.
/// @param judge   called by several threads.
/// @return verdicts per state, each in the order of the pairs.
std::vector<Verdict> verdictsOf(const RobotModel& robot, const Scene& scene, const std::vector<std::size_t>& pairs,
                                const std::vector<JointPositions>& states, const Judge& judge);

}  // namespace sdf_ccd
