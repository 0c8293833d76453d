#pragma once

#include <string>

#include "robot/plan_from_now.h"
#include "ros/tf/robot_frames.h"
#include "ros/world/checked_world.h"

namespace sdf_ccd {

/// The poses at the newest transform of each frame, whatever its age.
struct CurrentPoses : PresentState {
  ros::Time oldest;          ///< time of the oldest of the moving links' newest transforms; 0 if none is known
  std::string oldest_frame;  ///< frame of that link
};

CurrentPoses currentPoses(const TfHistory& history, const RobotFrames& frames, const CheckedWorld& world);

/// Note about transforms that are older than `max_age` [s] at the time `time`; empty if none are.
std::string oldTransformsNote(const CurrentPoses& now, const ros::Time& time, double max_age);

}  // namespace sdf_ccd
