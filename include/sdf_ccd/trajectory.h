#pragma once

#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// A part of a motion, by the indices of its first and last time.
struct WaypointSpan {
  std::size_t first = 0;
  std::size_t last = 0;

  /// Whether it has no length: see CycleMotion::spans.
  bool empty() const { return first == last; }
};

/// Bodies farther than this from the world's origin are not checked [m]: there doubles round coordinates by 1e-8 m,
/// which the error bound does not include, and much farther they overflow.
constexpr double kFarthestPose = 1e8;

/// From this angle on, two poses do not determine the direction of a frame's rotation [rad].
constexpr double kAmbiguousTurn = 3.14159265358979323846 - 1e-6;

/// Where the bodies were during a cycle (t₀, t₁]. Between two times each body moves with a constant twist in the
/// world, along the shorter rotation: rotations of half a revolution and more between two times need times in between.
struct CycleMotion {
  std::vector<double> times;                  ///< [s] from t₀, increasing; first 0, last the cycle's length
  std::vector<std::vector<Isometry3d>> X_WB;  ///< per body, per time; or a single pose, of a body at rest
  std::vector<std::string> missing;  ///< per body: why its poses are not known, else empty; may be empty as a whole
  /// Per body: distance of the true motion of its ball from that of X_WB [m]; may be infinite, or empty (no error).
  std::vector<double> motion_error;

  /// Per pair of the scene: the part of the motion to check it over. An empty span delays the pair: its transforms are
  /// not known yet; at the last waypoint, it is done. No spans at all: every pair over all of the motion. Poses that no
  /// span needs are not read.
  std::vector<WaypointSpan> spans;

  /// Pose X_WB of a body at a time, by their indices.
  const Isometry3d& pose(std::size_t body, std::size_t time) const {
    return X_WB[body][std::min(time, X_WB[body].size() - 1)];
  }

  /// The part of the motion to check a pair over.
  WaypointSpan span(std::size_t pair) const { return spans.empty() ? WaypointSpan{0, times.size() - 1} : spans[pair]; }
};

/// How closely chords follow the arcs of points that rotate.
struct ChordOptions {
  double tolerance = 1e-4;  ///< chord error aimed at [m]
  int max_chords = 1000;    ///< per recorded interval; a larger deviation then remains in ErrorSources::chord
};

using JointPositions = std::map<std::string, double>;  ///< by joint name [rad or m]

/// By joint name: pose of the joint's child link in the joint's frame (the one that its `origin` gives).
using JointPoses = std::map<std::string, Isometry3d>;

/// State of a robot at one time.
struct RobotState {
  Isometry3d X_WR = Isometry3d::Identity();  ///< its root link
  JointPositions positions;                  ///< these and the poses: see RobotModel::forwardKinematics()
  JointPoses poses;
};

/// Waypoints, between which joints move at constant speed. Positions change linearly. Poses (of joints' frames, and of
/// the root) move on a straight line and rotate by slerp: the shortest rotation, about a fixed axis.
struct RobotTrajectory {
  std::vector<double> times;       ///< [s], increasing
  std::vector<RobotState> states;  ///< one per time; all name the same joints
  double joint_error = 0.0;        ///< bound on the deviation of joint positions [rad, m]
};

/// Joint values of a trajectory message at one time; velocities and accelerations may be empty.
struct JointWaypoint {
  double time = 0.0;  ///< [s]
  std::vector<double> positions, velocities = {}, accelerations = {};
};

/// A trajectory as ros_control's joint_trajectory_controller follows it: on quintic splines between points that
/// both have velocities and accelerations, on cubic ones between points that both have velocities, else linearly.
/// The splines are divided into linear pieces that deviate by no more than the tolerance, which becomes the
/// joint_error.
/// @param tolerance  positive [rad, m].
/// @throws std::invalid_argument if sizes do not fit, or it would take more than 100,000 pieces.
RobotTrajectory splined(const std::vector<std::string>& joints, const std::vector<JointWaypoint>& points,
                        double tolerance);

/// State at a time from the first to the last. @throws std::out_of_range if two states name different joints.
RobotState stateAt(const RobotTrajectory& trajectory, double time);

/// Combines two trajectories, with the waypoints of both; the root's poses are those of the second.
/// @throws std::invalid_argument if they do not begin and end at the same times.
RobotTrajectory merged(const RobotTrajectory& joints, const RobotTrajectory& joints_and_root);

/// A joint that a plan does not name, and its assumed position.
struct AssumedJoint {
  std::string name;
  double position;  ///< [rad or m]; NaN for planar and floating joints, whose pose is not one number
};

}  // namespace sdf_ccd
