#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "sdf_ccd/motion/cycle_motion.h"
#include "sdf_ccd/motion/sample_motion.h"
#include "sdf_ccd/robot/robot_trajectory.h"
#include "sdf_ccd/robot/unreachable_pairs.h"

namespace sdf_ccd {

/// A motion that is made piece by piece: all samples of a long one would take gigabytes.
struct PlannedMotion {
  std::vector<double> waypoints;  ///< where it may be cut, times from the first point on [s]

  /// Sets the motion of all bodies from one of the waypoints to a later one, times counting from the first of them.
  std::function<void(std::size_t first, std::size_t last, CycleMotion& motion)> piece;

  std::vector<double> samples;           ///< times of the plan's points [s], from the first
  std::vector<UncheckedPair> unchecked;  ///< left out of the scene, though this motion may bring them together
  std::vector<AssumedJoint> assumed;
  std::string notes;  ///< what a user should know of these, by whoever made the plan; may be empty
};

/// The bodies that a plan moves, or finds in its way.
struct PlannedBodies {
  std::vector<CarriedBody> bodies;
  std::vector<std::string>
      missing;  ///< per body: why its place is not known, in the world or on its link; may be empty
};

/// All bodies along a trajectory of the robot's joints.
/// @param robot  must outlive the motion.
/// @param unreachable  pairs that the scene leaves out as out of reach.
/// @throws as TrajectoryMotion; std::invalid_argument also if the plan is not complete.
PlannedMotion planAlong(const RobotModel& robot, const PlannedJoints& plan, const PlannedBodies& bodies,
                        const std::vector<UnreachablePair>& unreachable, const MotionSampling& sampling);

/// All bodies through given poses, at the motion's times; between two of them each turns the shorter way round.
/// @param is_moved  per body: whether the plan says where it goes, not the robot's joints.
/// @throws std::invalid_argument if the motion's sizes do not fit each other, its first time is not 0, it has spans, or
/// two poses of a body do not tell which way it turned (kAmbiguousTurn).
PlannedMotion planThrough(CycleMotion motion, const std::vector<bool>& is_moved,
                          const std::vector<UnreachablePair>& unreachable);

/// The same motion, so that only what stays farther apart than the margin is CLEAR: it counts as motion error, in the
/// errors' bound too. What comes nearer is UNCERTAIN, and so is a contact that is less deep.
/// @throws std::invalid_argument if the margin [m] is negative or not finite.
PlannedMotion withMargin(PlannedMotion motion, double margin);

}  // namespace sdf_ccd
