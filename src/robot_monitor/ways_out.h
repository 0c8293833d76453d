#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sdf_ccd/distances.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// A pair that is to be moved apart.
struct ClosePair {
  int link_a = -1, link_b = -1;  ///< that carry its bodies; −1: the body does not move with the robot's joints
  Vector3d p_A_W = Vector3d::Zero(), p_B_W = Vector3d::Zero();  ///< their nearest points
  Vector3d normal_W = Vector3d::Zero();                         ///< unit, from A to B; zero if it is not known
};

/// A joint, and how fast its motion moves a pair apart.
struct SeparatingJoint {
  std::string joint;
  double rate = 0.0;  ///< change of the distance by that of the position [m/rad or 1]; negative: decrease the position
};

/// Per pair the joints that move it apart, each by itself and the fastest first, without those that would bring another
/// one of the pairs closer. To first order: it holds for small motions. A mimic joint counts for its leader.
/// @param linkPose  X_WL by the link's index; none if it is not known.
std::vector<std::vector<SeparatingJoint>> waysOut(const RobotModel& robot, const std::vector<ClosePair>& pairs,
                                                  const std::function<std::optional<Isometry3d>(int link)>& linkPose);

}  // namespace sdf_ccd
