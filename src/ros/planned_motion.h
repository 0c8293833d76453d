#pragma once

#include <string>
#include <vector>

#include "ros/tf_tracker.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// Where things are that a planned motion does not move.
struct CurrentPoses {
  Isometry3d X_WR = Isometry3d::Identity();  ///< of the robot's root link
  std::string root_missing;                  ///< why that is not known; empty if it is
  std::vector<Isometry3d> X_WB;              ///< per body
  std::vector<std::string> missing;          ///< per body: why that is not known
};

/// What a planned motion moves.
struct PlannedScene {
  const Scene& scene;
  const RobotModel& robot;
  CurrentPoses now;
  MotionSampling sampling;
};

/// The motion of all bodies along the request's joint trajectory or link poses.
/// @param samples  set to the times of the request's points, from the first.
/// @throws std::invalid_argument, saying what is wrong with the request.
CycleMotion toCycleMotion(const QueryMotion::Request& request, const PlannedScene& scene, std::vector<double>& samples);

}  // namespace sdf_ccd
