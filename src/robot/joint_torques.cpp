#include "robot/joint_torques.h"

#include <algorithm>

#include "joint_kind.h"
#include "urdf_geometry.h"

namespace sdf_ccd {

JointTorques::JointTorques(const RobotModel& robot) {
  const int links = static_cast<int>(robot.links().size());
  for (int link = 0; link < links; ++link) {
    parent_.push_back(robot.parent(link));
    if (link == 0) continue;
    const urdf::Joint& joint = robot.jointAbove(link);
    if (!joint.mimic && hasPosition(joint)) joints_.push_back(joint.name);
  }
  for (int link = 1; link < links; ++link) {
    const urdf::Joint& joint = robot.jointAbove(link);
    if (!hasPosition(joint)) continue;
    const auto leader = std::find(joints_.begin(), joints_.end(), robot.leader(joint).name);
    if (leader == joints_.end()) continue;
    // The joint's frame and that of the link below it share the axis, whatever the position is.
    below_.push_back(link);
    joints_below_.push_back({link, static_cast<int>(leader - joints_.begin())});
    parts_.push_back({static_cast<int>(leader - joints_.begin()), robot.multiplier(joint), rotates(joint),
                      toEigen(joint.axis).normalized()});
  }
}

void JointTorques::compute(const std::vector<Isometry3d>& X_WL, const std::vector<Wrench>& wrenches,
                           std::vector<double>& torques) const {
  torques.assign(joints_.size(), 0.0);
  for (std::size_t link = 0; link < wrenches.size(); ++link) {
    const Wrench& wrench = wrenches[link];
    if (wrench.force.isZero(0.0) && wrench.torque.isZero(0.0)) continue;
    // It acts on all joints between the link and the root.
    for (int above = static_cast<int>(link); above >= 0; above = parent_[above]) {
      const auto found = std::lower_bound(below_.begin(), below_.end(), above);
      if (found == below_.end() || *found != above) continue;
      const Part& part = parts_[static_cast<std::size_t>(found - below_.begin())];
      const Vector3d axis_W = X_WL[above].linear() * part.axis_L;
      const Vector3d lever = X_WL[link].translation() - X_WL[above].translation();
      const double along =
          part.rotates ? axis_W.dot(wrench.torque + lever.cross(wrench.force)) : axis_W.dot(wrench.force);
      torques[part.joint] += part.multiplier * along;
    }
  }
}

}  // namespace sdf_ccd
