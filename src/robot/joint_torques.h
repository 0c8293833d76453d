#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sdf_ccd/result.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// Joint torques and forces of wrenches on a robot's links: the generalised forces τ = Σ Jᵀ F of revolute and prismatic
/// joints. Their product with the joint rates is the power of the wrenches, as long as the root does not move: motors
/// that hold the robot against them must exert −τ.
///
/// A mimic joint has no torque: its part is added to its leader, times its multiplier.
class JointTorques {
 public:
  explicit JointTorques(const RobotModel& robot);

  /// The joints, in the order of RobotModel::links() below them.
  const std::vector<std::string>& joints() const { return joints_; }

  /// Links whose poses are needed, by their indices in RobotModel::links(): those right below a joint that moves.
  const std::vector<int>& links() const { return below_; }

  /// Each of links() with the joint, by its index in joints(), to which the joint above the link contributes.
  const std::vector<std::pair<int, int>>& jointsBelow() const { return joints_below_; }

  /// @param X_WL      per link: its pose; must be set for links().
  /// @param wrenches  per link: on it, about its origin, in the world's axes [N, N·m]; X_WL must be set where it is not
  ///                  zero.
  /// @param torques   per joint [N·m], or force [N] if it is prismatic; its memory is reused.
  void compute(const std::vector<Isometry3d>& X_WL, const std::vector<Wrench>& wrenches,
               std::vector<double>& torques) const;

 private:
  /// A joint, or one that mimics it.
  struct Part {
    int joint;  // in joints()
    double multiplier;
    bool rotates;     // else it translates
    Vector3d axis_L;  // in the frame of the link below it, unit
  };

  std::vector<std::string> joints_;
  std::vector<int> below_;  // per part: the link below it
  std::vector<Part> parts_;
  std::vector<std::pair<int, int>> joints_below_;
  std::vector<int> parent_;  // per link: −1 of the root
};

}  // namespace sdf_ccd
