#pragma once

#include <cstdio>
#include <string>

#include "oracle/random.h"
#include "robot/trajectory_motion.h"

/// Random robots and trajectories, also unrealistic ones.
namespace sdf_ccd::test {

inline std::string numbers(const Vector3d& v) {
  char text[96];
  std::snprintf(text, sizeof(text), "%.17g %.17g %.17g", v.x(), v.y(), v.z());
  return text;
}

/// A chain of `joints` joints of all types, j0 below link l0 and so on, each with a length up to `scale` [m] or none.
inline std::string randomChain(Random& random, int joints, double scale) {
  std::string links = "<link name='l0'/>", elements;
  std::vector<std::string> leaders;
  const char* const types[] = {"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};
  for (int i = 0; i < joints; ++i) {
    const std::string name = "j" + std::to_string(i);
    const int pick = static_cast<int>(random() % 9);  // mostly revolute
    const std::string type = types[pick < 6 ? pick : 0];
    links += "<link name='l" + std::to_string(i + 1) + "'/>";
    elements += "<joint name='" + name + "' type='" + type + "'><parent link='l" + std::to_string(i) +
                "'/><child link='l" + std::to_string(i + 1) + "'/>";
    const double length = random() % 4 ? scale * uniform(random, 0, 1) : 0.0;
    elements += "<origin xyz='" + numbers(length * direction(random)) + "' rpy='" +
                numbers(3.0 * uniform(random, 0, 1) * direction(random)) + "'/>";
    if (type != "fixed" && type != "floating") {
      elements += "<axis xyz='" + numbers(uniform(random, 0.1, 10) * direction(random)) + "'/>";
    }
    if (type == "revolute" || type == "prismatic") {
      elements += "<limit lower='-1' upper='1' effort='1' velocity='1'/>";
      if (!leaders.empty() && random() % 4 == 0) {
        elements += "<mimic joint='" + leaders[random() % leaders.size()] + "' multiplier='" +
                    std::to_string(uniform(random, -2, 2)) + "' offset='" + std::to_string(uniform(random, -1, 1)) +
                    "'/>";
      }
    }
    if (type == "revolute" || type == "continuous") leaders.push_back(name);
    elements += "</joint>";
  }
  return "<robot name='chain'>" + links + elements + "</robot>";
}

/// Waypoints one second apart. From one to the next, joints rotate by up to `turn`, translate by up to `scale` [m], or
/// rest; usually the root rests too.
inline RobotTrajectory randomTrajectory(Random& random, const RobotModel& robot, int waypoints, double turn,
                                        double scale) {
  RobotTrajectory trajectory;
  const bool root_rests = random() % 3 > 0;
  for (int i = 0; i < waypoints; ++i) {
    RobotState state = i > 0 ? trajectory.states.back() : RobotState();
    const auto moved = [&](const Isometry3d& X) { return X * pose(random, std::min(turn, 3.1), scale); };
    if (!root_rests) state.X_WR = moved(state.X_WR);
    for (const auto& [name, joint] : robot.urdf().joints_) {
      const bool slides = joint->type == urdf::Joint::PRISMATIC;
      if (joint->type == urdf::Joint::FIXED) continue;
      if (joint->type == urdf::Joint::FLOATING || joint->type == urdf::Joint::PLANAR) {
        const auto known = state.poses.find(name);
        state.poses[name] = moved(known == state.poses.end() ? Isometry3d::Identity() : known->second);
      } else if (!joint->mimic && random() % 5 > 0) {
        state.positions[name] += (slides ? scale : turn) * uniform(random, -1, 1);
      } else if (!joint->mimic) {
        state.positions[name] += 0.0;
      }
    }
    trajectory.times.push_back(i);
    trajectory.states.push_back(state);
  }
  return trajectory;
}

}  // namespace sdf_ccd::test
