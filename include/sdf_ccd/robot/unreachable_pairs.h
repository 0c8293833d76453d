#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/robot/robot_trajectory.h"

namespace sdf_ccd {

/// The reason that describeRobot() and disableUnreachable() give.
extern const char* const kOutOfReach;

/// A pair that is left out of a scene because its bodies never meet, and the assumptions of this.
struct UnreachablePair {
  int body_a = -1, body_b = -1;           ///< in SceneDescription::bodies
  BoundingBall ball_a, ball_b;            ///< contain the geometry, in the body's frame; infinite for half-spaces
  std::vector<RobotModel::Slide> slides;  ///< prismatic joints between them, which must stay in their ranges
};

/// Why pairs that assume this range are not out of reach with the joint at this position; empty if they are.
std::string beyondReach(const RobotModel::Slide& slide, double position);

/// @param scene  with all pairs allowed that will be.
std::vector<UnreachablePair> unreachablePairs(const RobotModel& robot, const SceneDescription& scene);

/// The pairs whose prismatic joints leave the assumed range, or are not known. Between two waypoints positions lie
/// between those at both.
std::vector<UncheckedPair> reachableAlong(const RobotModel& robot, const PlannedJoints& plan,
                                          const std::vector<UnreachablePair>& pairs);

/// The pairs whose balls may meet, if bodies move independently of joints. Conservative: for two balls that pass each
/// other only the lengths of their displacements are used.
/// @param is_moved  per body; pairs without such a body are skipped.
std::vector<UncheckedPair> reachableAlong(const CycleMotion& motion, const std::vector<bool>& is_moved,
                                          const std::vector<UnreachablePair>& pairs);

}  // namespace sdf_ccd
