#pragma once

#include <map>
#include <string>
#include <vector>

#include "sdf_ccd/motion/screw_motion.h"
#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// Where a robot is at one time.
struct RobotState {
  Isometry3d X_WR = Isometry3d::Identity();  ///< its root link
  JointPositions positions;                  ///< as RobotModel::forwardKinematics() takes them, as the following
  JointPoses poses;
};

/// Waypoints; between two of them every joint moves evenly. Positions change linearly. What is given as a pose slides
/// linearly and turns evenly (slerp) the shortest way about an axis that does not turn: joints' frames and the root.
struct RobotTrajectory {
  std::vector<double> times;       ///< [s], increasing
  std::vector<RobotState> states;  ///< one per time; all name the same joints
  double joint_error = 0.0;        ///< no joint that has a position is farther than this from there [rad, m]
};

/// What a trajectory message gives of its joints at one time; velocities and accelerations may be left empty.
struct JointWaypoint {
  double time = 0.0;  ///< [s]
  std::vector<double> positions, velocities, accelerations;
};

/// A trajectory as ros_control's joint_trajectory_controller follows it: on quintic splines between points that both
/// have velocities and accelerations, on cubic ones between those that have velocities, else linearly. The splines are
/// cut into pieces on which joints move linearly, no farther off than the tolerance: that is the joint_error.
/// @param points     two or more, of increasing times.
/// @param tolerance  positive [rad, m].
/// @throws std::invalid_argument if sizes do not fit, or it would take more than 100,000 pieces.
RobotTrajectory splined(const std::vector<std::string>& joints, const std::vector<JointWaypoint>& points,
                        double tolerance);

/// Where the robot is at a time from the first to the last. @throws std::out_of_range if two states name other joints.
RobotState stateAt(const RobotTrajectory& trajectory, double time);

/// Both at once, with the waypoints of both; the root is where the second has it.
/// @throws std::invalid_argument if they do not begin and end at the same times.
RobotTrajectory merged(const RobotTrajectory& joints, const RobotTrajectory& joints_and_root);

/// A body that moves with a link, or rests.
struct CarriedBody {
  int link = -1;                             ///< by its index in RobotModel::links(); −1: the body rests
  Isometry3d X_LB = Isometry3d::Identity();  ///< its frame in the link's; of a body that rests, in the world
  BoundingBall ball_B;                       ///< holds its points
};

/// What is known of a robot now.
struct CurrentJoints {
  std::map<std::string, Isometry3d> X_PL;      ///< by joint: its child link in its parent link's frame
  std::map<std::string, std::string> missing;  ///< by joint: why that is not known
};

/// A joint that a plan does not name, and where it is taken to be.
struct AssumedJoint {
  std::string name;
  double position;  ///< [rad or m]; NaN for planar and floating joints: their pose has no one number
};

/// A plan in which every joint has its place.
struct PlannedJoints {
  RobotTrajectory trajectory;
  std::vector<AssumedJoint> assumed;       ///< in the order of RobotModel::links()
  std::vector<std::string> beyond_limits;  ///< what an assumed position exceeds, in words
  std::vector<std::string> missing;        ///< per link: why its place in the root's frame is not known; empty if it is
};

struct PlanRules {
  bool allow_beyond_limits = false;  ///< take positions as they are
};

/// Completes a plan: joints that it does not name, and whose leader it does not name, rest where they are now, with the
/// very pose of their link (a position follows from it, not the other way round). If that is not known, fixed joints
/// are where the URDF has them; of others all links below are missing.
///
/// Refused are, by std::invalid_argument with joint, value and limit:
/// - a joint that does not exist, a position or pose that is not finite, or planar and floating joints with a position
///   and others with a pose; a planar joint's pose outside its plane (by 1e-6);
/// - a fixed joint that is to be elsewhere than at 0, a mimic joint elsewhere than its leader has it (both by 1e-6),
/// and
///   one whose leader is not named;
/// - revolute and prismatic joints, those that mimic one too, beyond their limits (by 1e-6, which covers what is
/// rounded
///   to single precision), unless PlanRules allow it. Limits that are given the wrong way round count as if they were
///   given the right way. Positions that are assumed are never refused, but said.
PlannedJoints completePlan(const RobotModel& robot, const RobotTrajectory& named, const CurrentJoints& now,
                           const PlanRules& rules);

}  // namespace sdf_ccd
