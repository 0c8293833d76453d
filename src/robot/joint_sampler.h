#pragma once

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// Draws random joint positions within a robot's limits; equal for equal seeds, on every machine.
///
/// Three of four states are uniform: within the limits, in either order; over a full revolution for continuous joints
/// and for revolute joints without limits (two equal ones), or over more if joints that mimic them turn at another rate
/// or slide. In every fourth state each limited joint is at one of its limits with probability ½, because arms are
/// folded most there. Mimic joints follow their leaders (RobotModel::forwardKinematics()), also beyond limits of their
/// own, as nothing keeps them there. Planar and floating joints, and prismatic ones without limits, have no bounded
/// range and keep their position (see isUnbounded()).
class JointSampler {
 public:
  JointSampler(const RobotModel& robot, std::uint64_t seed);

  JointPositions next();

  /// Revolute joints without limits.
  const std::vector<std::string>& withoutLimits() const { return without_limits_; }

  /// Whether the joint, or the one that it mimics, is not sampled although it moves.
  static bool isUnbounded(const RobotModel& robot, const urdf::Joint& joint);

  /// The first such joint between two links, given by their indices; empty if there is none.
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
