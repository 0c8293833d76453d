#pragma once

#include <optional>
#include <vector>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// The joints that move between two links, each as the index in RobotModel::links() of the link below it.
std::vector<int> jointsThatMove(const RobotModel& robot, int link_a, int link_b);

/// Whether the link is the other one, or below it in the tree.
bool isBelow(const RobotModel& robot, int link, int above);

/// Upper bound of the speed at which the distance of two bodies decreases with all joints at the speeds that the URDF
/// limits them to [m/s]; infinite if a joint between them has no limit.
///
/// Let a and b be the nearest points of the bodies, n the direction between them. A joint with axis ω through p changes
/// their distance at the rate q̇ ω·((b − p) × n) = q̇ ω·((a − p) × n), since b − a is along n: at most |q̇| times the
/// lesser of both points' distances from p, or |q̇| for one that slides.
/// @param ball_a, ball_b  contain the bodies, in their links' frames.
double maxClosingSpeed(const RobotModel& robot, int link_a, const BoundingBall& ball_a, int link_b,
                       const BoundingBall& ball_b);

/// A line in space.
struct Axis {
  Vector3d origin, direction;  ///< [m], unit
};

/// The one line about which all joints between two links rotate, in the frame of link A with all joints at rest;
/// whatever their positions, it stays where it is in both links. None if there is no such line.
/// @param X_RL  RobotModel::forwardKinematics() at rest.
std::optional<Axis> commonAxis(const RobotModel& robot, const std::vector<Isometry3d>& X_RL, int link_a, int link_b);

}  // namespace sdf_ccd
