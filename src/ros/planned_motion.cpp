#include "ros/planned_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <stdexcept>

#include "ros/conversions.h"

namespace sdf_ccd {
namespace {

using Trajectory = trajectory_msgs::JointTrajectory;

constexpr double kTurn = 1.0;                  // most that a link turns between two knots [rad]
constexpr std::size_t kMostAddedKnots = 2000;  // about 300 revolutions

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument(what);
}

/// Times from the first point on.
template <class Point>
std::vector<double> timesOf(const std::vector<Point>& points, const std::string& name) {
  if (points.size() < 2) refuse(name + " has " + std::to_string(points.size()) + " points, two or more are needed");
  std::vector<double> times;
  for (std::size_t i = 0; i < points.size(); ++i) {
    times.push_back((points[i].time_from_start - points.front().time_from_start).toSec());
    if (i > 0 && times[i] <= times[i - 1]) {
      refuse(name + ": time_from_start of point " + std::to_string(i) + " does not increase");
    }
  }
  return times;
}

int indexOf(const std::vector<std::string>& names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

JointPositions namedPositions(const std::vector<std::string>& names, const std::vector<double>& positions,
                              const std::string& what) {
  if (names.size() != positions.size()) {
    refuse(what + " has " + std::to_string(positions.size()) + " positions for " + std::to_string(names.size()) +
           " joints");
  }
  JointPositions result;
  for (std::size_t i = 0; i < names.size(); ++i) result[names[i]] = positions[i];
  return result;
}

/// The times, and so many between them that no link turns by more than kTurn from one to the next: two links then turn
/// by less than half a revolution against each other, and their poses alone tell which way.
std::vector<double> knotsOf(const std::vector<double>& times, const std::vector<JointPositions>& waypoints,
                            const RobotModel& robot) {
  std::vector<double> knots = {times.front()};
  std::size_t added = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double turn = robot.turn(waypoints[i - 1], waypoints[i]);
    const double pieces = std::max(1.0, std::ceil(turn / kTurn));
    if (!(pieces - 1.0 <= static_cast<double>(kMostAddedKnots - added))) {
      char text[160];
      std::snprintf(text, sizeof(text),
                    "the trajectory turns a link by %.3g rad up to point %zu: more than %zu rad "
                    "beside one per point are not checked",
                    turn, i, kMostAddedKnots);
      refuse(text);
    }
    added += static_cast<std::size_t>(pieces) - 1;
    for (double piece = 1.0; piece < pieces; ++piece) {
      knots.push_back(times[i - 1] + piece / pieces * (times[i] - times[i - 1]));
    }
    knots.push_back(times[i]);
  }
  return knots;
}

CycleMotion alongTrajectory(const QueryMotion::Request& request, const PlannedScene& planned,
                            const std::vector<double>& times) {
  const Trajectory& trajectory = request.trajectory;
  const JointPositions others = namedPositions(request.other_joints, request.other_positions, "other_positions");
  std::vector<JointPositions> waypoints;
  for (std::size_t i = 0; i < times.size(); ++i) {
    JointPositions positions = namedPositions(trajectory.joint_names, trajectory.points[i].positions,
                                              "point " + std::to_string(i) + " of the trajectory");
    positions.insert(others.begin(), others.end());
    waypoints.push_back(positions);
  }

  CycleMotion motion;
  motion.missing = planned.now.missing;
  std::vector<int> link_of_body;
  std::vector<BoundingBall> balls;
  for (std::size_t body = 0; body < planned.scene.bodies.size(); ++body) {
    const Body& description = planned.scene.bodies[body];
    link_of_body.push_back(description.is_world ? -1 : indexOf(planned.robot.links(), description.name));
    balls.push_back(motionBall(description));
    if (link_of_body.back() >= 0) motion.missing[body] = planned.now.root_missing;
  }
  const PosesAt poses_at = [&](double time, std::vector<Isometry3d>& X_WB) {
    const std::size_t end = std::clamp<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin(),
                                                    1, times.size() - 1);
    const double s = (time - times[end - 1]) / (times[end] - times[end - 1]);
    JointPositions positions = waypoints[end - 1];
    for (auto& [joint, position] : positions) position += s * (waypoints[end].at(joint) - position);
    const std::vector<Isometry3d> X_RL = planned.robot.forwardKinematics(positions);
    X_WB = planned.now.X_WB;
    for (std::size_t body = 0; body < X_WB.size(); ++body) {
      if (link_of_body[body] < 0) continue;
      X_WB[body] = planned.now.X_WR * X_RL[link_of_body[body]] * planned.scene.bodies[body].X_frame_B;
    }
  };
  sampleMotion(knotsOf(times, waypoints, planned.robot), poses_at, balls, planned.sampling, motion);
  return motion;
}

CycleMotion alongLinkPoses(const QueryMotion::Request& request, const PlannedScene& planned,
                           const std::vector<double>& times) {
  CycleMotion motion;
  motion.times = times;
  motion.missing = planned.now.missing;
  for (const Isometry3d& X_WB : planned.now.X_WB) motion.X_WB.emplace_back(times.size(), X_WB);
  for (const std::string& link : request.links) {
    if (indexOf(planned.robot.links(), link) < 0) refuse("the robot has no link " + link);
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    const std::vector<geometry_msgs::Pose>& poses = request.poses[i].poses;
    if (poses.size() != request.links.size()) {
      refuse("poses " + std::to_string(i) + " has " + std::to_string(poses.size()) + " for " +
             std::to_string(request.links.size()) + " links");
    }
    for (std::size_t body = 0; body < planned.scene.bodies.size(); ++body) {
      const Body& description = planned.scene.bodies[body];
      const int link = description.is_world ? -1 : indexOf(request.links, description.name);
      if (link < 0) continue;
      motion.X_WB[body][i] = toIsometry(poses[link]) * description.X_frame_B;
      motion.missing[body].clear();
    }
  }
  return motion;
}

}  // namespace

CycleMotion toCycleMotion(const QueryMotion::Request& request, const PlannedScene& planned,
                          std::vector<double>& samples) {
  const bool trajectory = !request.trajectory.points.empty();
  if (trajectory == !request.poses.empty()) refuse("give either a trajectory or poses of links");
  samples = trajectory ? timesOf(request.trajectory.points, "the trajectory") : timesOf(request.poses, "poses");
  return trajectory ? alongTrajectory(request, planned, samples) : alongLinkPoses(request, planned, samples);
}

}  // namespace sdf_ccd
