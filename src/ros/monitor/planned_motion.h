#pragma once

#include <functional>
#include <string>
#include <vector>

#include "motion/motion_sampling.h"
#include "robot/planned_motion.h"
#include "ros/monitor/current_poses.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// The scene and the present poses that a planned motion starts from.
struct PlannedScene {
  const Scene& scene;
  const RobotModel& robot;
  std::string base_joint;  ///< the SRDF's virtual joint of the root link; may be empty
  CurrentPoses now;
  MotionSampling sampling;
};

/// The motion of all bodies along the request's joint trajectory or link poses. A body whose frame is below a link's
/// moves with that link.
/// @param scene  must outlive the motion.
/// @throws std::invalid_argument with the reason, if the request is invalid.
PlannedMotion toPlannedMotion(const QueryMotion::Request& request, const PlannedScene& scene);

}  // namespace sdf_ccd
