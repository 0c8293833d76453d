#include "robot_monitor/ways_out.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "robot/joint_chain.h"
#include "robot/joint_kind.h"
#include "robot/urdf_geometry.h"

namespace sdf_ccd {
namespace {

/// Change of the pair's distance by the position of the joint above a link [m/rad or 1].
double rateOf(const RobotModel& robot, int below, const Isometry3d& X_WL, const ClosePair& pair) {
  const urdf::Joint& joint = robot.jointAbove(below);
  const Vector3d axis_W = X_WL.linear() * toEigen(joint.axis).normalized();
  const auto along = [&](int link, const Vector3d& p_W) {
    if (link < 0 || !isBelow(robot, link, below)) return 0.0;
    const Vector3d v_W = rotates(joint) ? Vector3d(axis_W.cross(p_W - X_WL.translation())) : axis_W;
    return v_W.dot(pair.normal_W);
  };
  return along(pair.link_b, pair.p_B_W) - along(pair.link_a, pair.p_A_W);
}

}  // namespace

std::vector<std::vector<SeparatingJoint>> waysOut(const RobotModel& robot, const std::vector<ClosePair>& pairs,
                                                  const std::function<std::optional<Isometry3d>(int link)>& linkPose) {
  constexpr double kNone = 1e-3;                     // slower is as good as not at all [m/rad or 1]
  std::map<std::string, std::vector<double>> rates;  // by joint, per pair
  std::set<std::string> unknown;                     // joints
  const int count = static_cast<int>(robot.links().size());
  for (int below = 1; below < count; ++below) {
    const urdf::Joint& joint = robot.jointAbove(below);
    const auto moves = [&](const ClosePair& pair) {
      const bool moves_a = pair.link_a >= 0 && isBelow(robot, pair.link_a, below);
      return moves_a != (pair.link_b >= 0 && isBelow(robot, pair.link_b, below));
    };
    if (!hasPosition(joint) || std::none_of(pairs.begin(), pairs.end(), moves)) continue;
    const std::optional<Isometry3d> X_WL = linkPose(below);
    if (!X_WL) {
      unknown.insert(robot.leader(joint).name);
      continue;
    }
    std::vector<double>& of_joint = rates.try_emplace(robot.leader(joint).name, pairs.size(), 0.0).first->second;
    for (std::size_t p = 0; p < pairs.size(); ++p)
      if (moves(pairs[p])) of_joint[p] += robot.multiplier(joint) * rateOf(robot, below, *X_WL, pairs[p]);
  }
  std::vector<std::vector<SeparatingJoint>> ways(pairs.size());
  for (const auto& [joint, of_joint] : rates) {
    if (unknown.count(joint) > 0) continue;
    for (std::size_t p = 0; p < pairs.size(); ++p) {
      const double rate = of_joint[p];
      const auto closes = [&](double other) { return other * (rate > 0.0 ? 1.0 : -1.0) < -1e-9; };
      if (std::abs(rate) < kNone || std::any_of(of_joint.begin(), of_joint.end(), closes)) continue;
      ways[p].push_back({joint, rate});
    }
  }
  for (std::vector<SeparatingJoint>& joints : ways)
    std::sort(joints.begin(), joints.end(),
              [](const SeparatingJoint& a, const SeparatingJoint& b) { return std::abs(a.rate) > std::abs(b.rate); });
  return ways;
}

}  // namespace sdf_ccd
