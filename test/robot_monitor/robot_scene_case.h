#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/robot_scene.h"

/// An arm whose contacts and distances are known.
namespace sdf_ccd::test {

using Names = std::vector<std::pair<std::string, std::string>>;

/// Two links in a row that rotate about y: along the arm, the upper one is from 0.05 to 0.45 m from the shoulder, which
/// is in the world's origin, and the fore one from 0.52 to 0.88 m, 4 cm wide.
inline const std::string kBase = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>)";
inline const std::string kUpper = R"(
  <link name="upper"><collision><origin xyz="0 0 0.25"/><geometry><box size="0.05 0.05 0.4"/></geometry></collision>
  </link>)";
inline const std::string kFore = R"(
  <link name="fore"><collision><origin xyz="0 0 0.2"/><geometry><box size="0.04 0.04 0.36"/></geometry></collision>
  </link>)";
inline const std::string kJoints = R"(
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";
inline const std::string kArm = kBase + kUpper + kFore + kJoints;

constexpr double kPostAngle = 0.75, kPostAt = 0.7, kRadius = 0.03;  // a ball that the fore link passes through
constexpr double kHalfWidth = 0.02;                                 // of the fore link
inline const double kTouchAngle = std::asin((kHalfWidth + kRadius) / kPostAt);  // between arm and ball when they touch

inline Vector3d along(double angle, double distance) {
  return distance * Vector3d(std::sin(angle), 0.0, std::cos(angle));
}

inline WorldObject ball(const std::string& name, const Vector3d& center, double radius, const std::string& frame = {}) {
  return {name, frame, Isometry3d(Eigen::Translation3d(center)), {{Sphere{radius}}}};
}

inline const WorldObject kPost = ball("post", along(kPostAngle, kPostAt), kRadius);

/// At constant speed; the elbow stays straight.
inline RobotTrajectory swing(double from, double to, double start = 0.0, double end = 1.0) {
  RobotTrajectory trajectory;
  trajectory.times = {start, end};
  trajectory.states.resize(2);
  trajectory.states[0].positions = {{"shoulder", from}, {"elbow", 0.0}};
  trajectory.states[1].positions = {{"shoulder", to}, {"elbow", 0.0}};
  return trajectory;
}

inline bool hasLine(const std::vector<std::string>& lines, const std::string& part) {
  for (const std::string& line : lines)
    if (line.find(part) != std::string::npos) return true;
  return false;
}

/// The message of the exception that a call throws; empty if it throws none of this type.
template <class Error>
std::string messageOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

}  // namespace sdf_ccd::test
