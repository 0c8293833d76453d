#pragma once

#include <functional>
#include <string>
#include <vector>

#include "ros/tf/tf_history.h"
#include "sdf_ccd/QueryMotion.h"
#include "sdf_ccd/monitor/scene.h"
#include "sdf_ccd/robot/planned_motion.h"

namespace sdf_ccd {

/// The link that a body's frame hangs on.
struct Carrier {
  int link = -1;                             ///< by its index in RobotModel::links(); −1: none
  Isometry3d X_LB = Isometry3d::Identity();  ///< the body's frame in the link's
};

/// Where things are now, for all that a planned motion does not say.
struct CurrentPoses {
  Isometry3d X_WR = Isometry3d::Identity();  ///< of the robot's root link
  std::string root_missing;                  ///< why that is not known; empty if it is
  CurrentJoints joints;
  std::vector<Isometry3d> X_WB;      ///< per body
  std::vector<std::string> missing;  ///< per body: why that is not known
  std::vector<Carrier> carriers;     ///< per body

  ros::Time oldest;          ///< of the newest transforms of the robot's moving links, the oldest; 0 if none is known
  std::string oldest_frame;  ///< that link's

  Isometry3d X_WM = Isometry3d::Identity();  ///< of the frame that the plan's root poses are given in
  std::string plan_frame_missing;
};

/// What a planned motion moves.
struct PlannedScene {
  const Scene& scene;
  const RobotModel& robot;
  std::string base_joint;  ///< the SRDF's virtual joint of the root link; may be empty
  const std::vector<UnreachablePair>& unreachable;
  CurrentPoses now;
  MotionSampling sampling;
};

/// The robot's frames in tf: its links, with tf's prefix.
struct RobotFrames {
  const RobotModel& robot;
  std::string prefix;

  std::string operator()(int link) const { return prefix + robot.links()[link]; }
};

/// From the newest transform of each frame, whatever its age. Bodies' own poses are left to the caller.
CurrentPoses currentPoses(const TfHistory& history, const RobotFrames& frames, const Scene& scene);

/// What a user should know of transforms that are older than `max_age` [s] at the time `time`; empty if none are.
std::string oldTransformsNote(const CurrentPoses& now, const ros::Time& time, double max_age);

/// The motion of all bodies along the request's joint trajectory or link poses. A body whose frame is not a link's but
/// hangs below one moves with it.
/// @param scene  must outlive the motion.
/// @throws std::invalid_argument, saying what is wrong with the request.
PlannedMotion toPlannedMotion(const QueryMotion::Request& request, const PlannedScene& scene);

}  // namespace sdf_ccd
