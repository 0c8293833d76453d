#pragma once

#include <string>

#include "motion/motion_sampling.h"
#include "robot/plan_from_now.h"
#include "robot/planned_motion.h"
#include "sdf_ccd/RobotMotion.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// What a planned motion starts from.
struct PlannedScene {
  const Scene& scene;
  const RobotModel& robot;
  std::string base_joint;  ///< the SRDF's virtual joint of the root link; may be empty
  PresentState now;
  PlanRules rules;
  Isometry3d X_WM = Isometry3d::Identity();  ///< of the frame in which motions give the root's poses
  std::string plan_frame_missing = {};       ///< why that is not known; empty if it is
  std::string note = {};                     ///< about the present poses, for the user; may be empty
};

/// The motion of all bodies along the message's trajectories or link poses.
/// @param scene  must outlive the motion.
/// @throws std::invalid_argument with the reason, if the message is invalid.
PlannedMotion toPlannedMotion(const RobotMotion& motion, const PlannedScene& scene, const MotionSampling& sampling);

/// Number of points of all of its trajectories.
std::size_t pointsOf(const RobotMotion& motion);

}  // namespace sdf_ccd
