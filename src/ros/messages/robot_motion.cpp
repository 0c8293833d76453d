#include "ros/messages/robot_motion.h"

#include <algorithm>
#include <set>

#include "common/counted.h"
#include "common/number_text.h"
#include "common/refuse.h"
#include "motion/motion_sampling.h"
#include "robot/planned_motion.h"
#include "ros/messages/conversions.h"
#include "ros/tf/seconds_between.h"

namespace sdf_ccd {
namespace {

/// Times [s] since `start`.
template <class Point>
std::vector<double> timesOf(const std::vector<Point>& points, const ros::Duration& start, const std::string& name) {
  if (points.size() < 2) refuse(name + " has " + std::to_string(points.size()) + " points; two or more are needed");
  std::vector<double> times;
  for (std::size_t i = 0; i < points.size(); ++i) {
    times.push_back(secondsBetween(start, points[i].time_from_start));
    if (i > 0 && times[i] <= times[i - 1]) {
      refuse(name + ": time_from_start of point " + std::to_string(i) +
             " is not greater than that of the point before");
    }
    if (std::abs(times[i]) > kLongestDuration) {
      refuse(name + ": time_from_start of point " + std::to_string(i) + " is " + numberText(times[i]) +
             " s after the first point; a ros::Duration holds at most " +
             std::to_string(std::int64_t(kLongestDuration)) + " s");
    }
  }
  return times;
}

void requireSize(std::size_t given, std::size_t wanted, const std::string& what) {
  if (given == wanted) return;
  refuse(what + " has " + std::to_string(given) + " positions for " + std::to_string(wanted) + " joints");
}

void requireNamedOnce(const RobotMotion& motion) {
  std::set<std::string> names;
  for (const auto* list : {&motion.joint_trajectory.joint_names, &motion.other_joints.name,
                           &motion.multi_dof_joint_trajectory.joint_names}) {
    for (const std::string& name : *list) {
      if (!names.insert(name).second) refuse("joint " + name + " is named twice");
    }
  }
}

/// On splines, as joint_trajectory_controller does.
RobotTrajectory toSplines(const trajectory_msgs::JointTrajectory& trajectory, const ros::Duration& start,
                          double tolerance) {
  const std::vector<double> times = timesOf(trajectory.points, start, "the trajectory");
  std::vector<JointWaypoint> points;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const trajectory_msgs::JointTrajectoryPoint& point = trajectory.points[i];
    points.push_back({times[i], point.positions, point.velocities, point.accelerations});
  }
  return splined(trajectory.joint_names, points, tolerance);
}

RobotTrajectory toRobotTrajectory(const trajectory_msgs::JointTrajectory& trajectory, const ros::Duration& start) {
  RobotTrajectory result;
  result.times = timesOf(trajectory.points, start, "the trajectory");
  for (std::size_t i = 0; i < result.times.size(); ++i) {
    const std::vector<double>& positions = trajectory.points[i].positions;
    requireSize(positions.size(), trajectory.joint_names.size(), "point " + std::to_string(i) + " of the trajectory");
    RobotState state;
    for (std::size_t k = 0; k < positions.size(); ++k) state.positions[trajectory.joint_names[k]] = positions[k];
    result.states.push_back(state);
  }
  return result;
}

/// Whether a joint's name is that of the root link, or of the SRDF's virtual joint above it.
bool isRoot(const std::string& name, const PlannedScene& planned) {
  return name == planned.base_joint || name == planned.robot.root();
}

/// The pose of the root link is in the message's frame; all others are in their joint's frame.
RobotTrajectory toRobotTrajectory(const trajectory_msgs::MultiDOFJointTrajectory& trajectory,
                                  const ros::Duration& start, const PlannedScene& planned) {
  RobotTrajectory result;
  result.times = timesOf(trajectory.points, start, "the multi_dof_joint_trajectory");
  for (std::size_t i = 0; i < result.times.size(); ++i) {
    const std::string what = "point " + std::to_string(i) + " of the multi_dof_joint_trajectory";
    const auto& transforms = trajectory.points[i].transforms;
    requireSize(transforms.size(), trajectory.joint_names.size(), what);
    RobotState state;
    for (std::size_t k = 0; k < transforms.size(); ++k) {
      const std::string& name = trajectory.joint_names[k];
      const Isometry3d X = toIsometry(transforms[k]);
      if (isRoot(name, planned)) {
        state.X_WR = planned.X_WM * X;
      } else {
        state.poses[name] = X;
      }
    }
    result.states.push_back(state);
  }
  return result;
}

/// The joint positions and poses in the message, at all its times.
/// @param tolerance  of samples of the motion [m].
JointPlan toJointPlan(const RobotMotion& motion, const PlannedScene& planned, double tolerance) {
  requireNamedOnce(motion);
  const auto& joints = motion.joint_trajectory.points;
  const auto& multi_dof = motion.multi_dof_joint_trajectory;
  const ros::Duration start =
      joints.empty() ? multi_dof.points.front().time_from_start : joints.front().time_from_start;
  JointPlan plan;
  plan.moves_root = std::any_of(multi_dof.joint_names.begin(), multi_dof.joint_names.end(),
                                [&](const std::string& name) { return isRoot(name, planned); });
  plan.root_missing = planned.plan_frame_missing;
  if (!joints.empty()) {
    // Errors of joints add up along a chain: each may deviate by a quarter of the tolerance of the motion's samples
    // [rad, m].
    plan.named = motion.interpolation == RobotMotion::SPLINES
                     ? toSplines(motion.joint_trajectory, start, 0.25 * tolerance)
                     : toRobotTrajectory(motion.joint_trajectory, start);
  }
  if (!multi_dof.points.empty()) {
    const RobotTrajectory poses = toRobotTrajectory(multi_dof, start, planned);
    plan.named = joints.empty() ? poses : merged(plan.named, poses);
  }
  const sensor_msgs::JointState& others = motion.other_joints;
  requireSize(others.position.size(), others.name.size(), "other_joints");
  for (RobotState& state : plan.named.states)
    for (std::size_t k = 0; k < others.name.size(); ++k) state.positions[others.name[k]] = others.position[k];
  return plan;
}

LinkPlan toLinkPlan(const LinkTrajectory& trajectory) {
  LinkPlan plan;
  plan.times = timesOf(trajectory.points, trajectory.points.front().time_from_start, "the link_trajectory");
  plan.links = trajectory.link_names;
  plan.X_WL.resize(plan.links.size());
  for (std::size_t i = 0; i < trajectory.points.size(); ++i) {
    const std::vector<geometry_msgs::Pose>& poses = trajectory.points[i].poses;
    if (poses.size() != plan.links.size())
      refuse("point " + std::to_string(i) + " of the link_trajectory has " + std::to_string(poses.size()) +
             " poses for " + std::to_string(plan.links.size()) + " links");
    for (std::size_t link = 0; link < poses.size(); ++link) plan.X_WL[link].push_back(toIsometry(poses[link]));
  }
  return plan;
}

/// Notes that objects whose frames are below the robot's links move along if the base moves, and never obstruct it.
/// Usually their frame is the root link because no frame at rest was given.
std::string carriedObjectsNote(const PlannedScene& planned) {
  std::vector<std::string> names;
  for (std::size_t body = 0; body < planned.scene.bodies.size(); ++body)
    if (planned.scene.bodies[body].is_world && planned.now.bodies.bodies[body].link >= 0)
      names.push_back(planned.scene.bodies[body].name);
  if (names.empty()) return {};
  return "these objects move with the robot's base, because their tf frames are below it: " + firstOf(names, 3) +
         "; to keep them in place, set their frame or fixed_frame to one that does not move";
}

}  // namespace

std::size_t pointsOf(const RobotMotion& motion) {
  return motion.joint_trajectory.points.size() + motion.multi_dof_joint_trajectory.points.size() +
         motion.link_trajectory.points.size();
}

PlannedMotion toPlannedMotion(const RobotMotion& motion, const PlannedScene& planned, const MotionSampling& sampling) {
  if (motion.interpolation > RobotMotion::SPLINES)
    refuse("interpolation " + std::to_string(motion.interpolation) + " is neither LINEAR nor SPLINES");
  const bool has_joints = !motion.joint_trajectory.points.empty() || !motion.multi_dof_joint_trajectory.points.empty();
  const bool has_links = !motion.link_trajectory.points.empty();
  if (has_joints == has_links || (has_links && !motion.other_joints.name.empty()))
    refuse("give either trajectories of joints or of links, and not both");
  PlannedMotion result;
  if (has_links) {
    result = planFromNow(planned.robot, toLinkPlan(motion.link_trajectory), planned.now);
  } else {
    const JointPlan plan = toJointPlan(motion, planned, sampling.tolerance);
    result = planFromNow(planned.robot, plan, planned.now, planned.rules, sampling);
    if (const std::string carried = plan.moves_root ? carriedObjectsNote(planned) : ""; !carried.empty())
      result.notes.push_back(carried);
  }
  if (!planned.note.empty()) result.notes.push_back(planned.note);
  return result;
}

}  // namespace sdf_ccd
