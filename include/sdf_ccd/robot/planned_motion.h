#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/robot/robot_scene.h"
#include "sdf_ccd/robot/robot_trajectory.h"

namespace sdf_ccd {

/// A motion that is made piece by piece, because all samples of a long motion would take gigabytes.
struct PlannedMotion {
  std::vector<double> waypoints;  ///< times at which it can be split, from the first point on [s]

  /// Sets the motion of all bodies from one waypoint to a later one; times count from the first of the two.
  std::function<void(std::size_t first, std::size_t last, CycleMotion& motion)> piece;

  std::vector<double> samples;           ///< times of the plan's points [s], from the first
  std::vector<UncheckedPair> unchecked;  ///< left out of the scene, though this motion may bring them together
  std::vector<AssumedJoint> assumed;
  std::string notes;  ///< notes for the user about these, by the author of the plan; may be empty
};

/// The bodies that a plan moves, or may hit.
struct PlannedBodies {
  std::vector<CarriedBody> bodies;
  /// Per body: why its pose in the world or on its link is not known; may be empty.
  std::vector<std::string> missing;
};

/// The motion of all bodies along a trajectory of the robot's joints.
/// @param robot  must outlive the motion.
/// @param unreachable  pairs that the scene leaves out as out of reach.
/// @throws as TrajectoryMotion; std::invalid_argument also if the plan is not complete.
PlannedMotion planAlong(const RobotModel& robot, const PlannedJoints& plan, const PlannedBodies& bodies,
                        const std::vector<UnreachablePair>& unreachable, const MotionSampling& sampling);

/// The motion of all bodies through given poses, at the motion's times; each takes the shorter rotation between two.
/// @param is_moved  per body: whether its poses come from the plan, not from the robot's joints.
/// @throws std::invalid_argument if the motion's sizes are inconsistent, its first time is not 0, it has spans, or two
/// poses of a body leave the direction of its rotation open (kAmbiguousTurn).
PlannedMotion planThrough(CycleMotion motion, const std::vector<bool>& is_moved,
                          const std::vector<UnreachablePair>& unreachable);

/// The same motion with a margin: only pairs that stay farther apart than it are CLEAR. It counts as motion error, also
/// in the error bound. Pairs that come closer are UNCERTAIN, as are contacts less deep than the margin.
/// @throws std::invalid_argument if the margin [m] is negative or not finite.
PlannedMotion withMargin(PlannedMotion motion, double margin);

}  // namespace sdf_ccd
