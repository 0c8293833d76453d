#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sdf_ccd/robot/robot_model.h"

namespace sdf_ccd {

/// Draws joint positions within a robot's limits; the same ones for the same seed, on every machine.
///
/// Three of four states are uniform: within the limits, either way round, and of continuous joints over a full
/// revolution; so also of revolute joints without limits, that is with two equal ones. In the fourth every limited
/// joint stands at one of its limits with probability ½: there arms are folded farthest. Mimic joints follow their
/// leaders (RobotModel::forwardKinematics()). Planar and floating joints, and prismatic ones without limits, range over
/// locations that nothing bounds; they are left where they are (see unbounded()).
class JointSampler {
 public:
  JointSampler(const RobotModel& robot, std::uint64_t seed);

  JointPositions next();

  /// Revolute joints without limits.
  const std::vector<std::string>& withoutLimits() const { return without_limits_; }

  /// Whether the joint, or the one that it mimics, is not drawn although it moves.
  static bool isUnbounded(const RobotModel& robot, const urdf::Joint& joint);

  /// The first of those between two links, given by their indices; empty if there is none.
  static std::string unboundedBetween(const RobotModel& robot, int link_a, int link_b);

 private:
  struct Joint {
    std::string name;
    double lower, upper;  // [rad or m]
    bool has_limits;
  };

  double uniform();  // in [0, 1)

  std::vector<Joint> joints_;
  std::vector<std::string> without_limits_;
  std::mt19937_64 random_;
  std::uint64_t count_ = 0;
};

}  // namespace sdf_ccd
