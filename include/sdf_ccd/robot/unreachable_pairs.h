#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/robot/robot_trajectory.h"

namespace sdf_ccd {

/// The reason that describeRobot() and disableUnreachable() give.
extern const char* const kOutOfReach;

/// A pair that is left out of a scene because its bodies never come near each other, and what that rests on.
struct UnreachablePair {
  int body_a = -1, body_b = -1;           ///< in SceneDescription::bodies
  BoundingBall ball_a, ball_b;            ///< hold the geometry, each in its body's frame; infinite for half-spaces
  std::vector<RobotModel::Slide> slides;  ///< prismatic joints between them: it holds as long as these stay within
};

/// Why pairs that rest on it are not out of reach while the joint is at this position; empty if they are.
std::string beyondReach(const RobotModel::Slide& slide, double position);

/// @param scene  when all pairs are disabled that will be.
std::vector<UnreachablePair> unreachablePairs(const RobotModel& robot, const SceneDescription& scene);

/// The pairs whose prismatic joints do not stay within what they rest on, or are not known. Between two waypoints
/// positions lie between those at both.
std::vector<UncheckedPair> reachableAlong(const RobotModel& robot, const PlannedJoints& plan,
                                          const std::vector<UnreachablePair>& pairs);

/// The pairs whose balls may meet, where bodies go where no joint needs to take them. Conservative: of two balls that
/// pass each other it takes no more than how far they go.
/// @param is_moved  per body; pairs of which neither is are passed over.
std::vector<UncheckedPair> reachableAlong(const CycleMotion& motion, const std::vector<bool>& is_moved,
                                          const std::vector<UnreachablePair>& pairs);

}  // namespace sdf_ccd
