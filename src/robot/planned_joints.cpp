#include "sdf_ccd/trajectory.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/number_text.h"
#include "robot/planned_motion.h"
#include "urdf_geometry.h"

namespace sdf_ccd {
namespace {

constexpr double kTolerance = 1e-6;  // of positions [rad or m]

[[noreturn]] void refuse(const urdf::Joint& joint, const std::string& what) {
  throw std::invalid_argument("joint " + joint.name + ": " + what);
}

bool hasManyDegrees(const urdf::Joint& joint) {
  return joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR;
}

/// The limit that a position exceeds, as text; empty if none.
std::string exceeds(const urdf::Joint& joint, double position) {
  const bool limited = joint.limits && (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC);
  if (!limited) return {};
  const double lower = joint.limits->lower, upper = joint.limits->upper;
  if (lower - kTolerance <= position && position <= upper + kTolerance) return {};
  return "position " + numberText(position) + " is beyond its limits [" + numberText(lower) + ", " + numberText(upper) +
         "]";
}

class Planner {
 public:
  Planner(const RobotModel& robot, const RobotTrajectory& named, const CurrentJoints& now, const PlanRules& rules)
      : robot_(robot), now_(now), rules_(rules) {
    plan_.trajectory = named;
    plan_.missing.resize(robot.links().size());
  }

  PlannedJoints complete() {
    const std::vector<RobotState>& states = plan_.trajectory.states;
    for (const RobotState& state : states) {
      robot_.forwardKinematics(state.positions, state.poses);  // refuses joints that do not exist
    }
    for (int link = 1; link < static_cast<int>(robot_.links().size()); ++link) {
      const urdf::Joint& joint = robot_.jointAbove(link);
      plan_.missing[link] = plan_.missing[robot_.parent(link)];
      if (isNamed(joint)) {
        for (std::size_t i = 0; i < states.size(); ++i) check(joint, states[i], i);
      } else {
        assume(joint, plan_.missing[link]);
      }
    }
    return std::move(plan_);
  }

 private:
  /// Whether the plan names the joint or its leader.
  bool isNamed(const urdf::Joint& joint) const {
    const RobotState& state = plan_.trajectory.states.front();
    const bool is_named = state.positions.count(joint.name) || state.poses.count(joint.name);
    if (joint.type == urdf::Joint::FIXED) {
      if (is_named) checkFixed(joint);
      return false;
    }
    if (!joint.mimic) return is_named;
    const std::string& leader = robot_.leader(joint).name;
    const bool is_led = state.positions.count(leader) > 0;
    if (is_named && !is_led) refuse(joint, "follows " + leader + ", which is not named");
    return is_led;
  }

  /// A fixed joint may be named, but cannot move.
  void checkFixed(const urdf::Joint& joint) const {
    for (std::size_t i = 0; i < plan_.trajectory.states.size(); ++i) {
      const RobotState& state = plan_.trajectory.states[i];
      const auto position = state.positions.find(joint.name);
      if (position == state.positions.end()) refuse(joint, "a fixed joint has no pose to plan");
      if (std::abs(position->second) > kTolerance) {
        refuse(joint,
               "is fixed, and cannot be at " + numberText(position->second) + " (waypoint " + std::to_string(i) + ")");
      }
    }
  }

  void check(const urdf::Joint& joint, const RobotState& state, std::size_t waypoint) const {
    const std::string at = " (waypoint " + std::to_string(waypoint) + ")";
    const auto pose = state.poses.find(joint.name);
    if (pose != state.poses.end()) return checkPose(joint, pose->second, at);
    if (hasManyDegrees(joint)) refuse(joint, "has several degrees of freedom: give poses, not positions");
    const double position = robot_.position(joint, state.positions);
    if (joint.mimic && state.positions.count(joint.name) > 0) {
      JointPositions others = state.positions;
      others.erase(joint.name);
      const double led = robot_.position(joint, others);
      if (!(std::abs(position - led) <= kTolerance)) {
        refuse(joint, "cannot be at " + numberText(position) + at + ": " + robot_.leader(joint).name + " has it at " +
                          numberText(led));
      }
    }
    const std::string exceeded = exceeds(joint, position);
    if (!exceeded.empty() && !rules_.allow_beyond_limits) refuse(joint, exceeded + at);
  }

  void checkPose(const urdf::Joint& joint, const Isometry3d& X_JC, const std::string& at) const {
    if (!hasManyDegrees(joint)) refuse(joint, "has one degree of freedom: give positions, not poses");
    if (joint.type == urdf::Joint::FLOATING) return;
    const Vector3d normal = toEigen(joint.axis).normalized();
    const double off = std::abs(normal.dot(X_JC.translation()));
    const double tilt = (X_JC.linear() * normal - normal).norm();
    if (!(off <= kTolerance && tilt <= kTolerance)) refuse(joint, "is planar, and its pose outside the plane" + at);
  }

  void assume(const urdf::Joint& joint, std::string& missing) {
    const auto now = now_.X_PL.find(joint.name);
    const bool is_fixed = joint.type == urdf::Joint::FIXED;
    if (now == now_.X_PL.end()) {
      if (is_fixed || !missing.empty()) return;
      const auto why = now_.missing.find(joint.name);
      missing = "joint " + joint.name + " is not in the plan, and its current position is unknown" +
                (why == now_.missing.end() ? "" : ": " + why->second);
      return;
    }
    const Isometry3d X_JC = toEigen(joint.parent_to_joint_origin_transform).inverse() * now->second;
    for (RobotState& state : plan_.trajectory.states) state.poses[joint.name] = X_JC;
    if (is_fixed) return;
    const double position = robot_.positionAt(joint, now->second);
    plan_.assumed.push_back({joint.name, position});
    const std::string exceeded = exceeds(joint, position);
    if (!exceeded.empty()) plan_.beyond_limits.push_back("joint " + joint.name + ": " + exceeded);
  }

  const RobotModel& robot_;
  const CurrentJoints& now_;
  const PlanRules& rules_;
  PlannedJoints plan_;
};

}  // namespace

PlannedJoints completePlan(const RobotModel& robot, const RobotTrajectory& named, const CurrentJoints& now,
                           const PlanRules& rules) {
  return Planner(robot, named, now, rules).complete();
}

}  // namespace sdf_ccd
