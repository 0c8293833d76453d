#pragma once

#include <vector>

#include "ros/monitor/planned_motion.h"

/// Queries take joints that a plan does not name from tf. Where it has them otherwise than the URDF, pairs that were
/// left out because of the URDF are compared with the poses that the query uses, as in cycles.
namespace sdf_ccd {

/// Whether tf has a joint's child where no position of the joint takes it.
bool doJointsDeviate(const RobotModel& robot, const CurrentJoints& joints);

/// Adds pairs that are left out though the motion has them elsewhere to PlannedMotion::unchecked.
void addContradicted(const PlannedScene& planned, PlannedMotion& motion);

/// The same, of bodies that stay where they are on the robot.
/// @param is_moved  per body; pairs with one are not looked at.
void addContradicted(const PlannedScene& planned, const std::vector<bool>& is_moved, PlannedMotion& motion);

}  // namespace sdf_ccd
