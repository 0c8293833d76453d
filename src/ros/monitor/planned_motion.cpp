#include "ros/monitor/planned_motion.h"

#include <algorithm>
#include <memory>
#include <set>
#include <stdexcept>

#include "common/counted.h"
#include "common/number_text.h"
#include "common/refuse.h"
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

void requireNamedOnce(const QueryMotion::Request& request) {
  std::set<std::string> names;
  for (const auto* list : {&request.joint_trajectory.joint_names, &request.other_joints,
                           &request.multi_dof_joint_trajectory.joint_names}) {
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

/// The pose of the root link, which may be named after it or after the SRDF's virtual joint, is in the message's frame;
/// all others are in their joint's frame.
RobotTrajectory toRobotTrajectory(const trajectory_msgs::MultiDOFJointTrajectory& trajectory,
                                  const ros::Duration& start, const PlannedScene& planned) {
  RobotTrajectory result;
  result.times = timesOf(trajectory.points, start, "the multi_dof_joint_trajectory");
  for (std::size_t i = 0; i < result.times.size(); ++i) {
    const std::string what = "point " + std::to_string(i) + " of the multi_dof_joint_trajectory";
    const auto& transforms = trajectory.points[i].transforms;
    requireSize(transforms.size(), trajectory.joint_names.size(), what);
    RobotState state;
    state.X_WR = planned.now.X_WR;
    for (std::size_t k = 0; k < transforms.size(); ++k) {
      const std::string& name = trajectory.joint_names[k];
      const Isometry3d X = toIsometry(transforms[k]);
      if (name == planned.base_joint || name == planned.robot.root()) {
        state.X_WR = planned.now.X_WM * X;
      } else {
        state.poses[name] = X;
      }
    }
    result.states.push_back(state);
  }
  return result;
}

bool movesRoot(const QueryMotion::Request& request, const PlannedScene& planned) {
  const auto& names = request.multi_dof_joint_trajectory.joint_names;
  return std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return name == planned.base_joint || name == planned.robot.root();
  });
}

/// The joint positions and poses in the request, at all its times.
RobotTrajectory namedTrajectory(const QueryMotion::Request& request, const PlannedScene& planned) {
  requireNamedOnce(request);
  const auto& joints = request.joint_trajectory.points;
  const auto& multi_dof = request.multi_dof_joint_trajectory.points;
  const ros::Duration start = joints.empty() ? multi_dof.front().time_from_start : joints.front().time_from_start;
  RobotTrajectory named;
  if (!joints.empty()) {
    const bool on_splines = request.interpolation == QueryMotion::Request::SPLINES;
    // Errors of joints add up along a chain: each may deviate by a quarter of the tolerance of the motion's samples
    // [rad, m].
    named = on_splines ? toSplines(request.joint_trajectory, start, 0.25 * planned.sampling.tolerance)
                       : toRobotTrajectory(request.joint_trajectory, start);
    for (RobotState& state : named.states) state.X_WR = planned.now.X_WR;
  }
  if (!multi_dof.empty()) {
    const RobotTrajectory poses = toRobotTrajectory(request.multi_dof_joint_trajectory, start, planned);
    named = joints.empty() ? poses : merged(named, poses);
  }
  requireSize(request.other_positions.size(), request.other_joints.size(), "other_positions");
  for (RobotState& state : named.states) {
    for (std::size_t k = 0; k < request.other_joints.size(); ++k) {
      state.positions[request.other_joints[k]] = request.other_positions[k];
    }
  }
  return named;
}

std::string notesOf(const PlannedJoints& plan) {
  std::string notes;
  if (!plan.assumed.empty()) {
    notes = "not named, hence assumed to stay as in tf: " + counted(plan.assumed.size(), "joint");
  }
  for (const std::string& beyond : plan.beyond_limits) notes += (notes.empty() ? "" : "; ") + ("at present, " + beyond);
  return notes;
}

/// Notes that objects whose frames are below the robot's links move along if the base moves, and never obstruct it.
/// Usually their frame is the root link because no frame at rest was given.
std::string carriedObjectsNote(const PlannedScene& planned) {
  std::string names;
  int count = 0;
  for (std::size_t body = 0; body < planned.scene.bodies.size(); ++body) {
    if (!planned.scene.bodies[body].is_world || planned.now.carriers[body].link < 0) continue;
    if (++count <= 3) names += (count == 1 ? "" : ", ") + planned.scene.bodies[body].name;
  }
  if (count == 0) return {};
  return "these objects move with the robot's base, because their tf frames are below it: " + names +
         (count > 3 ? ", ..." : "") +
         "; to keep them in place, set their frame or fixed_frame to one that does not move";
}

PlannedMotion alongTrajectory(const QueryMotion::Request& request, const PlannedScene& planned) {
  const CurrentPoses& now = planned.now;
  const PlannedJoints plan = completePlan(planned.robot, namedTrajectory(request, planned), now.joints,
                                          {static_cast<bool>(request.allow_beyond_limits)});
  PlannedBodies bodies;
  bodies.missing = now.missing;
  for (std::size_t body = 0; body < planned.scene.bodies.size(); ++body) {
    const Carrier& carrier = now.carriers[body];
    const bool is_carried = carrier.link >= 0;
    bodies.bodies.push_back(
        {carrier.link, is_carried ? carrier.X_LB : now.X_WB[body], planned.scene.bodies[body].ball});
    if (is_carried) bodies.missing[body] = movesRoot(request, planned) ? now.plan_frame_missing : now.root_missing;
  }
  PlannedMotion result = planAlong(planned.robot, plan, bodies, planned.sampling);
  result.notes = notesOf(plan);
  const std::string carried = movesRoot(request, planned) ? carriedObjectsNote(planned) : "";
  if (!carried.empty()) result.notes += (result.notes.empty() ? "" : "; ") + carried;
  return result;
}

/// The poses of each named link.
std::vector<std::vector<Isometry3d>> linkPoses(const QueryMotion::Request& request) {
  std::vector<std::vector<Isometry3d>> X_WL(request.links.size());
  for (std::size_t i = 0; i < request.poses.size(); ++i) {
    const std::vector<geometry_msgs::Pose>& poses = request.poses[i].poses;
    if (poses.size() != request.links.size()) {
      refuse("poses[" + std::to_string(i) + "] has " + std::to_string(poses.size()) + " poses for " +
             std::to_string(request.links.size()) + " links");
    }
    for (std::size_t link = 0; link < poses.size(); ++link) X_WL[link].push_back(toIsometry(poses[link]));
  }
  for (std::size_t link = 0; link < X_WL.size(); ++link)
    requireUnambiguousTurns(X_WL[link], "link " + request.links[link]);
  return X_WL;
}

PlannedMotion alongLinkPoses(const QueryMotion::Request& request, const PlannedScene& planned) {
  const CurrentPoses& now = planned.now;
  CycleMotion motion;
  motion.times = timesOf(request.poses, request.poses.front().time_from_start, "poses");
  motion.missing = now.missing;
  for (const Isometry3d& X_WB : now.X_WB) motion.X_WB.emplace_back(motion.times.size(), X_WB);
  std::set<std::string> named;
  for (const std::string& link : request.links) {
    if (planned.robot.find(link) < 0) refuse("the robot has no link " + link);
    if (!named.insert(link).second) refuse("link " + link + " is named twice");
  }
  const std::vector<std::vector<Isometry3d>> X_WL = linkPoses(request);
  // Frames of tf are known up to different times: the other links are where the joints are, each at its own time.
  const PlannedJoints rest = completePlan(planned.robot, {{0.0}, {RobotState()}}, now.joints, {});
  const std::vector<Isometry3d> X_RL = planned.robot.forwardKinematics({}, rest.trajectory.states.front().poses);
  for (std::size_t body = 0; body < planned.scene.bodies.size(); ++body) {
    const Carrier& carrier = now.carriers[body];
    if (carrier.link < 0) continue;
    const auto link = std::find(request.links.begin(), request.links.end(), planned.robot.links()[carrier.link]);
    if (link == request.links.end()) {
      motion.X_WB[body].assign(motion.times.size(), now.X_WR * X_RL[carrier.link] * carrier.X_LB);
      std::string& missing = motion.missing[body];
      if (missing.empty()) missing = now.root_missing.empty() ? rest.missing[carrier.link] : now.root_missing;
      continue;
    }
    const std::vector<Isometry3d>& poses = X_WL[link - request.links.begin()];
    for (std::size_t i = 0; i < poses.size(); ++i) motion.X_WB[body][i] = poses[i] * carrier.X_LB;
    motion.missing[body].clear();
  }
  return planThrough(std::move(motion));
}

}  // namespace

PlannedMotion toPlannedMotion(const QueryMotion::Request& request, const PlannedScene& planned) {
  if (request.interpolation > QueryMotion::Request::SPLINES) {
    refuse("interpolation " + std::to_string(request.interpolation) + " is neither LINEAR nor SPLINES");
  }
  const bool has_joints =
      !request.joint_trajectory.points.empty() || !request.multi_dof_joint_trajectory.points.empty();
  if (has_joints == !request.poses.empty()) refuse("give either trajectories or poses of links, and not both");
  return has_joints ? alongTrajectory(request, planned) : alongLinkPoses(request, planned);
}

}  // namespace sdf_ccd
