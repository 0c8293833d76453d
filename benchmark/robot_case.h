#pragma once

#include <random>
#include <string>

#include "oracle/random.h"
#include "sdf_ccd/body.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::benchmark {

/// A robot and the scene of its links.
struct Robot {
  std::string name;
  RobotModel model;
  SceneDescription scene;
};

/// Loads a robot. @param argument  NAME=URDF or NAME=URDF,SRDF; packages are looked up in ROS_PACKAGE_PATH.
/// @throws std::invalid_argument for an argument of another form, std::runtime_error for a bad file.
Robot loadRobot(const std::string& argument);

/// Whether the joint has one position that can be set: revolute, continuous or prismatic, and not a mimic joint.
bool isDriven(const urdf::Joint& joint);

/// Range of a joint's positions [rad or m]; ±3.14 for a joint without limits.
struct JointRange {
  double low, high;
};
JointRange rangeOf(const urdf::Joint& joint);

/// Random positions of all driven joints, uniform within their ranges.
JointPositions randomPositions(const RobotModel& robot, std::mt19937_64& random);

/// A box of the world, fixed to the robot's root, with half sides of 3 to 15 cm.
BodyDescription randomBox(const Robot& robot, int number, test::Random& random);

/// Body options as the monitor has them by default. @param monitor  options of the monitor that will use the bodies.
BodyOptions preparedAsMonitored(const MonitorOptions& monitor);

}  // namespace sdf_ccd::benchmark
