#include "ros/bag/joint_frames.h"

#include <algorithm>
#include <cmath>

#include "robot/joint_kind.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd {

JointFrames::JointFrames(std::shared_ptr<const RobotModel> robot, const std::string& prefix)
    : robot_(std::move(robot)), frames_{*robot_, prefix} {}

std::vector<std::string> JointFrames::frames() const {
  std::vector<std::string> frames = frames_.all();
  frames.erase(frames.begin());
  return frames;
}

std::vector<std::string> JointFrames::movableFrames() const {
  std::vector<std::string> frames;
  for (int link = 1; link < static_cast<int>(robot_->links().size()); ++link)
    if (robot_->jointAbove(link).type != urdf::Joint::FIXED) frames.push_back(frames_(link));
  return frames;
}

template <class Joints>
bool JointFrames::isMoved(const urdf::Joint& joint, const Joints& by) const {
  return hasPosition(joint) && (by.count(joint.name) > 0 || by.count(robot_->leader(joint).name) > 0);
}

std::vector<std::string> JointFrames::movedFrames(const std::set<std::string>& joints) const {
  std::vector<std::string> frames;
  for (int link = 1; link < static_cast<int>(robot_->links().size()); ++link)
    if (isMoved(robot_->jointAbove(link), joints)) frames.push_back(frames_(link));
  return frames;
}

bool JointFrames::knows(const std::string& joint) const {
  return robot_->urdf().joints_.count(joint) > 0;
}

tf2_msgs::TFMessage JointFrames::fixed(const ros::Time& stamp,
                                       const std::function<bool(const std::string&)>& is_wanted) const {
  return transforms({}, stamp, [&](int link, const urdf::Joint& joint) {
    return joint.type == urdf::Joint::FIXED && is_wanted(frames_(link));
  });
}

tf2_msgs::TFMessage JointFrames::moved(const sensor_msgs::JointState& joints, const ros::Time& stamp) const {
  JointPositions positions;
  for (std::size_t i = 0; i < std::min(joints.name.size(), joints.position.size()); ++i) {
    if (std::isfinite(joints.position[i]) && knows(joints.name[i])) positions[joints.name[i]] = joints.position[i];
  }
  return transforms(positions, stamp, [&](int, const urdf::Joint& joint) { return isMoved(joint, positions); });
}

tf2_msgs::TFMessage JointFrames::transforms(
    const JointPositions& positions, const ros::Time& stamp,
    const std::function<bool(int link, const urdf::Joint& joint)>& is_wanted) const {
  const std::vector<Isometry3d> X_RL = robot_->forwardKinematics(positions);
  tf2_msgs::TFMessage message;
  for (int link = 1; link < static_cast<int>(X_RL.size()); ++link) {
    if (!is_wanted(link, robot_->jointAbove(link))) continue;
    const int parent = robot_->parent(link);
    const Isometry3d X_PL = X_RL[parent].inverse() * X_RL[link];
    message.transforms.push_back(toTransformStamped({stamp, frames_(parent), frames_(link)}, X_PL));
  }
  return message;
}

}  // namespace sdf_ccd
