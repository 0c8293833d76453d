#pragma once

#include <random>
#include <string>

#include "sdf_ccd/body/body_options.h"
#include "sdf_ccd/model/scene_description.h"
#include "sdf_ccd/monitor/monitor.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd::benchmark {

/// A robot of a study, and the scene of its links.
struct Robot {
  std::string name;
  RobotModel model;
  SceneDescription scene;
};

/// NAME=URDF or NAME=URDF,SRDF; meshes of packages are looked up in ROS_PACKAGE_PATH.
/// @throws std::invalid_argument for an argument of another form, std::runtime_error for a bad file.
Robot loadRobot(const std::string& argument);

/// Whether the joint has a position of its own that is a number: revolute, continuous or prismatic, and no mimic.
bool isDriven(const urdf::Joint& joint);

/// The positions that a joint is moved within [rad or m].
struct JointRange {
  double low, high;
};
JointRange rangeOf(const urdf::Joint& joint);

/// Positions of all driven joints within their ranges.
JointPositions randomPositions(const RobotModel& robot, std::mt19937_64& random);

/// Bodies as the monitor prepares them if nothing is configured. @param monitor  that they are for.
BodyOptions preparedAsMonitored(const MonitorOptions& monitor);

}  // namespace sdf_ccd::benchmark
