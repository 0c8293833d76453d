#include "robot/joint_chain.h"

#include <algorithm>
#include <cmath>

#include "common/infinity.h"
#include "robot/joint_kind.h"
#include "robot/urdf_geometry.h"

namespace sdf_ccd {
namespace {

/// Magnitude of a joint's largest speed [rad/s or m/s]; a limit of 0 means that none was given.
double maxSpeed(const RobotModel& robot, const urdf::Joint& joint) {
  if (!hasPosition(joint)) return kInfinity;
  const auto limit = [](const urdf::Joint& of) {
    const double speed = of.limits ? std::abs(of.limits->velocity) : 0.0;
    return speed > 0.0 && std::isfinite(speed) ? speed : kInfinity;
  };
  if (!joint.mimic) return limit(joint);
  return std::min(limit(joint), std::abs(robot.multiplier(joint)) * limit(robot.leader(joint)));
}

}  // namespace

std::vector<int> jointsThatMove(const RobotModel& robot, int link_a, int link_b) {
  std::vector<int> below;
  // Depth-first order: a parent's index is less than its children's.
  while (link_a != link_b) {
    int& deeper = link_a > link_b ? link_a : link_b;
    if (robot.jointAbove(deeper).type != urdf::Joint::FIXED) below.push_back(deeper);
    deeper = robot.parent(deeper);
  }
  return below;
}

bool isBelow(const RobotModel& robot, int link, int above) {
  while (link > above) link = robot.parent(link);
  return link == above;
}

double maxClosingSpeed(const RobotModel& robot, int link_a, const BoundingBall& ball_a, int link_b,
                       const BoundingBall& ball_b) {
  const auto leverTo = [&](int joint, int link, const BoundingBall& ball) {
    const auto name = [&](int of) { return robot.links()[static_cast<std::size_t>(of)]; };
    return robot.reach(name(joint), Vector3d::Zero(), name(link), ball.center) + ball.radius;
  };
  double speed = 0.0;
  for (const int joint : jointsThatMove(robot, link_a, link_b)) {
    const double of_joint = maxSpeed(robot, robot.jointAbove(joint));
    const double lever = rotates(robot.jointAbove(joint))
                             ? std::min(leverTo(joint, link_a, ball_a), leverTo(joint, link_b, ball_b))
                             : 1.0;
    speed += of_joint * lever;
  }
  return std::isnan(speed) ? kInfinity : speed;
}

std::optional<Axis> commonAxis(const RobotModel& robot, const std::vector<Isometry3d>& X_RL, int link_a, int link_b) {
  constexpr double kSame = 1e-9;  // rounding of the URDF's numbers [m, rad]
  const std::vector<int> joints = jointsThatMove(robot, link_a, link_b);
  const auto isRotation = [&](int joint) { return rotates(robot.jointAbove(joint)); };
  if (joints.empty() || !std::all_of(joints.begin(), joints.end(), isRotation)) return std::nullopt;
  std::optional<Axis> common;
  for (const int joint : joints) {
    // The axis is the same in the frames of the joint and of the link below it.
    const Isometry3d X_AJ = X_RL[static_cast<std::size_t>(link_a)].inverse() * X_RL[static_cast<std::size_t>(joint)];
    const Axis axis{X_AJ.translation(), X_AJ.linear() * toEigen(robot.jointAbove(joint).axis).normalized()};
    if (!common) common = axis;
    if (axis.direction.cross(common->direction).norm() > kSame ||
        (axis.origin - common->origin).cross(common->direction).norm() > kSame)
      return std::nullopt;
  }
  return common;
}

}  // namespace sdf_ccd
