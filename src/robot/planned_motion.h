#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "motion/motion_sampling.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// A body that moves with a link, or does not move.
struct CarriedBody {
  int link = -1;                             ///< by its index in RobotModel::links(); −1: it does not move
  Isometry3d X_LB = Isometry3d::Identity();  ///< its frame in the link's; in the world without a link
  BoundingBall ball_B;                       ///< contains its points
};

/// The current joint poses of a robot.
struct CurrentJoints {
  std::map<std::string, Isometry3d> X_PL;      ///< by joint: its child link in its parent link's frame
  std::map<std::string, std::string> missing;  ///< by joint: why that is not known
};

/// A plan that gives the position of every joint.
struct PlannedJoints {
  RobotTrajectory trajectory;
  std::vector<AssumedJoint> assumed;       ///< in the order of RobotModel::links()
  std::vector<std::string> beyond_limits;  ///< limits that assumed positions exceed, as text
  std::vector<std::string> missing;        ///< per link: why its pose in the root's frame is not known; empty if it is
};

/// What a plan may contain.
struct PlanRules {
  bool allow_beyond_limits = false;  ///< accept positions beyond limits
};

/// Completes a plan: a joint that it does not name, and whose leader it does not name, stays at the current pose of its
/// link (its position is computed from the pose, not the other way round). If the pose is not known, fixed joints are
/// at their pose in the URDF; for other joints, all links below are missing.
///
/// Rejected by std::invalid_argument, with joint, value and limit, are:
/// - a joint that does not exist; a position or pose that is not finite; planar and
///   floating joints with a position, other joints with a pose; a planar joint's pose
///   outside its plane (by 1e-6);
/// - a fixed joint with a position other than 0, a mimic joint whose position differs from
///   its leader's (both by 1e-6), and a mimic joint whose leader is not named;
/// - revolute and prismatic joints, also mimic joints, beyond their limits (by 1e-6, which
///   covers rounding to single precision), unless PlanRules allows it. Limits in the wrong
///   order are exchanged. Assumed positions are never rejected, but listed in
///   beyond_limits.
PlannedJoints completePlan(const RobotModel& robot, const RobotTrajectory& named, const CurrentJoints& now,
                           const PlanRules& rules);

/// A motion that is made piece by piece, because all samples of a long motion would take gigabytes.
struct PlannedMotion {
  std::vector<double> waypoints;  ///< times at which it can be split, from the first point on [s]

  /// Sets the motion of all bodies from one waypoint to a later one; times count from the first of the two.
  std::function<void(std::size_t first, std::size_t last, CycleMotion& motion)> piece;

  std::vector<double> samples;  ///< times of the plan's points [s], from the first

  std::vector<AssumedJoint> assumed;
  std::vector<std::string> notes;  ///< about these, for the user
};

/// The bodies that a plan moves, or may hit.
struct PlannedBodies {
  std::vector<CarriedBody> bodies;
  /// Per body: why its pose in the world or on its link is not known; may be empty.
  std::vector<std::string> missing;
};

/// The motion of all bodies along a trajectory of the robot's joints.
/// @param robot  must outlive the motion.
/// @throws as TrajectoryMotion; std::invalid_argument also if the plan is not complete.
PlannedMotion planAlong(const RobotModel& robot, const PlannedJoints& plan, const PlannedBodies& bodies,
                        const MotionSampling& sampling = {});

/// The motion of all bodies through given poses, at the motion's times; each takes the shorter rotation between two.
/// @throws std::invalid_argument if the motion's sizes are inconsistent, its first time is not 0, it has spans, or two
/// poses of a body leave the direction of its rotation open (kAmbiguousTurn).
PlannedMotion planThrough(CycleMotion motion);

}  // namespace sdf_ccd
