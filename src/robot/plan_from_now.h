#pragma once

#include <string>
#include <vector>

#include "motion/motion_sampling.h"
#include "robot/planned_motion.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// Where the robot and the bodies of its scene are now: what a planned motion does not specify stays there.
struct PresentState {
  std::string known_by;                      ///< who knows it, for notes: "tf"
  Isometry3d X_WR = Isometry3d::Identity();  ///< of the robot's root link
  std::string root_missing;                  ///< why that is not known; empty if it is
  CurrentJoints joints;
  PlannedBodies bodies;  ///< `missing` is read of those that no link carries
};

/// Joints that move, or are elsewhere than now, and the root if it moves.
struct JointPlan {
  RobotTrajectory named;
  bool moves_root = false;   ///< else RobotState::X_WR is not read
  std::string root_missing;  ///< why the poses of a root that moves are not known; empty if they are
};

/// Links at given poses, between which each moves with a constant twist.
struct LinkPlan {
  std::vector<double> times;  ///< [s], increasing
  std::vector<std::string> links;
  std::vector<std::vector<Isometry3d>> X_WL;  ///< per link, per time
};

/// The motion of all bodies, with notes for the user.
/// @param robot  must outlive the motion.
/// @throws std::invalid_argument as completePlan(), planAlong() and planThrough(); for a link that does not exist, or
/// is named twice.
///@{
PlannedMotion planFromNow(const RobotModel& robot, const JointPlan& plan, const PresentState& now,
                          const PlanRules& rules, const MotionSampling& sampling);
PlannedMotion planFromNow(const RobotModel& robot, const LinkPlan& plan, const PresentState& now);
///@}

}  // namespace sdf_ccd
