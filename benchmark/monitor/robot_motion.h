#pragma once

#include <cstdint>
#include <vector>

#include "robot_case.h"

namespace sdf_ccd::benchmark {

/// A motion of all driven joints of a robot. Each oscillates about a random position, with about 1 rad/s at most.
class RobotMotion {
 public:
  RobotMotion(const Robot& robot, std::uint64_t seed);

  JointPositions positionsAt(double time) const;

  /// Poses of the scene's bodies at a time [s], in the root's frame, in the order of their description.
  std::vector<Isometry3d> posesAt(double time, const std::vector<BodyDescription>& bodies) const;

 private:
  struct Wave {
    std::string joint;
    double middle, amplitude;  // [rad or m]
    double rate, phase;        // [rad/s], [rad]
  };

  const RobotModel* model_;
  std::vector<Wave> waves_;
};

/// Poses of bodies in the root's frame, in the order of their description.
std::vector<Isometry3d> posesAt(const RobotModel& model, const JointPositions& positions,
                                const std::vector<BodyDescription>& bodies);

}  // namespace sdf_ccd::benchmark
