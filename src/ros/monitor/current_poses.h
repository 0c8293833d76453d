#pragma once

#include <string>
#include <vector>

#include "robot/planned_motion.h"
#include "ros/tf/robot_frames.h"
#include "sdf_ccd/scene.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// The link that carries a body's frame.
struct Carrier {
  int link = -1;                             ///< index in RobotModel::links(); −1: none
  Isometry3d X_LB = Isometry3d::Identity();  ///< the body's frame in the link's
};

/// Present poses of everything that a planned motion does not specify.
struct CurrentPoses {
  Isometry3d X_WR = Isometry3d::Identity();  ///< of the robot's root link
  std::string root_missing;                  ///< why that is not known; empty if it is
  CurrentJoints joints;
  std::vector<Isometry3d> X_WB;      ///< per body
  std::vector<std::string> missing;  ///< per body: why that is not known
  std::vector<Carrier> carriers;     ///< per body

  ros::Time oldest;          ///< time of the oldest of the moving links' newest transforms; 0 if none is known
  std::string oldest_frame;  ///< frame of that link

  Isometry3d X_WM = Isometry3d::Identity();  ///< of the frame in which the plan's root poses are given
  std::string plan_frame_missing;
};

/// The poses at the newest transform of each frame, whatever its age. The caller sets those of the bodies.
CurrentPoses currentPoses(const TfHistory& history, const RobotFrames& frames, const Scene& scene);

/// Note about transforms that are older than `max_age` [s] at the time `time`; empty if none are.
std::string oldTransformsNote(const CurrentPoses& now, const ros::Time& time, double max_age);

}  // namespace sdf_ccd
