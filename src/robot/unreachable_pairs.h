#pragma once

#include <string>
#include <vector>

#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/robot/planned_motion.h"
#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd {

/// The reasons that describeRobot() and disableUnreachable() give.
extern const char *const kOutOfReach, *const kRigidlyJoined;

/// Whether a pair is left out for one of these, and not because a rule of the user allows it to touch.
bool isProof(const std::string& reason);

/// Whether the bodies of a pair that is rigidly joined are where the URDF has them, but for rounding and calibration:
/// no point of one of them moves by more than a millimetre in the other's frame.
bool areJoinedAt(const UnreachablePair& pair, const Isometry3d& X_AB);

/// Why pairs that assume this range are not out of reach with the joint at this position; empty if they are.
std::string beyondReach(const RobotModel::Slide& slide, double position);

/// Those pairs that no rule of the user allows to touch; nobody needs to watch the others.
std::vector<UnreachablePair> withoutAllowed(std::vector<UnreachablePair> pairs, const SceneDescription& scene);

/// The pairs whose prismatic joints leave the assumed range, or are not known. Between two waypoints positions lie
/// between those at both.
std::vector<UncheckedPair> reachableAlong(const RobotModel& robot, const PlannedJoints& plan,
                                          const std::vector<UnreachablePair>& pairs);

/// The pairs whose balls may meet, or that are not where they are rigidly joined, if bodies move independently of
/// joints. Conservative: for two balls that pass each other only the lengths of their displacements are used.
/// @param is_moved  per body; pairs without such a body are skipped.
std::vector<UncheckedPair> reachableAlong(const CycleMotion& motion, const std::vector<bool>& is_moved,
                                          const std::vector<UnreachablePair>& pairs);

}  // namespace sdf_ccd
