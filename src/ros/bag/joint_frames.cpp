#include "ros/bag/joint_frames.h"

#include <algorithm>
#include <cmath>

#include "robot/joint_kind.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd {

JointFrames::JointFrames(std::shared_ptr<const RobotModel> robot, const std::string& prefix)
    : robot_(std::move(robot)), prefix_(prefix) {
  const std::vector<std::string>& names = robot_->links();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const urdf::LinkConstSharedPtr link = robot_->urdf().getLink(names[i]);
    if (!link->parent_joint) continue;
    const auto parent = std::find(names.begin(), names.end(), link->parent_joint->parent_link_name);
    links_.push_back({link->parent_joint.get(), i, static_cast<std::size_t>(parent - names.begin())});
  }
}

std::vector<std::string> JointFrames::frames() const {
  std::vector<std::string> frames;
  for (const Link& link : links_) frames.push_back(prefix_ + robot_->links()[link.index]);
  return frames;
}

std::vector<std::string> JointFrames::movableFrames() const {
  std::vector<std::string> frames;
  for (const Link& link : links_)
    if (link.joint->type != urdf::Joint::FIXED) frames.push_back(prefix_ + robot_->links()[link.index]);
  return frames;
}

bool JointFrames::knows(const std::string& joint) const {
  return std::any_of(links_.begin(), links_.end(), [&](const Link& link) { return link.joint->name == joint; });
}

tf2_msgs::TFMessage JointFrames::fixed(const ros::Time& stamp,
                                       const std::function<bool(const std::string&)>& is_wanted) const {
  const std::vector<Isometry3d> X_RL = robot_->forwardKinematics({});
  tf2_msgs::TFMessage message;
  for (const Link& link : links_) {
    if (link.joint->type != urdf::Joint::FIXED || !is_wanted(prefix_ + robot_->links()[link.index])) continue;
    message.transforms.push_back(transform(link, X_RL, stamp));
  }
  return message;
}

tf2_msgs::TFMessage JointFrames::moved(const sensor_msgs::JointState& joints, const ros::Time& stamp) const {
  JointPositions positions;
  for (std::size_t i = 0; i < std::min(joints.name.size(), joints.position.size()); ++i) {
    if (std::isfinite(joints.position[i]) && knows(joints.name[i])) positions[joints.name[i]] = joints.position[i];
  }
  const std::vector<Isometry3d> X_RL = robot_->forwardKinematics(positions);
  tf2_msgs::TFMessage message;
  for (const Link& link : links_) {
    const urdf::Joint& joint = *link.joint;
    if (hasPosition(joint) && positions.count(robot_->leader(joint).name) > 0)
      message.transforms.push_back(transform(link, X_RL, stamp));
  }
  return message;
}

geometry_msgs::TransformStamped JointFrames::transform(const Link& link, const std::vector<Isometry3d>& X_RL,
                                                       const ros::Time& stamp) const {
  const Isometry3d X_PL = X_RL[link.parent].inverse() * X_RL[link.index];
  const std::vector<std::string>& names = robot_->links();
  return toTransformStamped({stamp, prefix_ + names[link.parent], prefix_ + names[link.index]}, X_PL);
}

}  // namespace sdf_ccd
