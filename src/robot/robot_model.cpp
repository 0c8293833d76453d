#include "sdf_ccd/robot.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/number_text.h"
#include "error_source.h"
#include "joint_motion.h"
#include "parse_urdf.h"
#include "urdf_geometry.h"

namespace sdf_ccd {

RobotModel::RobotModel(const std::string& urdf_xml, const std::string& source) try {
  ParsedUrdf parsed = parseUrdf(urdf_xml);
  urdf_ = std::move(parsed.model);
  root_ = urdf_->getRoot()->name;
  unread_ = std::move(parsed.unread);
  warnings_ = std::move(parsed.warnings);
  std::vector<std::pair<const urdf::Link*, int>> open = {{urdf_->getRoot().get(), -1}};
  while (!open.empty()) {
    const auto [link, parent] = open.back();
    open.pop_back();
    const int index = static_cast<int>(links_.size());
    links_.push_back(link->name);
    index_[link->name] = index;
    parent_.push_back(parent);
    for (auto child = link->child_links.rbegin(); child != link->child_links.rend(); ++child) {
      open.emplace_back(child->get(), index);
    }
  }
} catch (const std::exception& error) {
  throwFrom(source, error);
}

int RobotModel::find(const std::string& link) const {
  const auto found = index_.find(link);
  return found == index_.end() ? -1 : found->second;
}

int RobotModel::indexOf(const std::string& link) const {
  const int index = find(link);
  if (index < 0) throw std::invalid_argument("robot " + urdf_->name_ + " has no link " + link);
  return index;
}

const urdf::Joint& RobotModel::jointAbove(int link) const {
  return *urdf_->links_.at(links_[link])->parent_joint;
}

const urdf::Joint& RobotModel::leader(const urdf::Joint& joint) const {
  return joint.mimic ? leader(*urdf_->joints_.at(joint.mimic->joint_name)) : joint;
}

double RobotModel::multiplier(const urdf::Joint& joint) const {
  return joint.mimic ? joint.mimic->multiplier * multiplier(*urdf_->joints_.at(joint.mimic->joint_name)) : 1.0;
}

double RobotModel::position(const urdf::Joint& joint, const JointPositions& positions) const {
  const auto found = positions.find(joint.name);
  if (found != positions.end()) return found->second;
  if (joint.mimic) {
    const urdf::Joint& leader = *urdf_->joints_.at(joint.mimic->joint_name);
    return joint.mimic->multiplier * position(leader, positions) + joint.mimic->offset;
  }
  const bool limited = joint.limits && (joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::PRISMATIC);
  return limited ? std::max(joint.limits->lower, std::min(0.0, joint.limits->upper)) : 0.0;
}

void RobotModel::requireKnown(const JointPositions& positions, const JointPoses& poses) const {
  for (const auto& [name, pose] : poses) {
    if (!urdf_->joints_.count(name)) throw std::invalid_argument("robot " + urdf_->name_ + " has no joint " + name);
    if (!pose.matrix().allFinite()) throw std::invalid_argument("joint " + name + ": its pose is not finite");
  }
  for (const auto& [name, value] : positions) {
    if (!urdf_->joints_.count(name)) throw std::invalid_argument("robot " + urdf_->name_ + " has no joint " + name);
    if (!std::isfinite(value)) {
      throw std::invalid_argument("joint " + name + ": position " + numberText(value) + " is not finite");
    }
  }
}

std::vector<Isometry3d> RobotModel::forwardKinematics(const JointPositions& positions, const JointPoses& poses) const {
  requireKnown(positions, poses);
  std::vector<Isometry3d> X_RL(links_.size(), Isometry3d::Identity());
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const urdf::Joint& joint = jointAbove(static_cast<int>(i));
    const auto pose = poses.find(joint.name);
    X_RL[i] = X_RL[parent_[i]] * toEigen(joint.parent_to_joint_origin_transform) *
              (pose != poses.end() ? pose->second : jointMotion(joint, position(joint, positions)));
  }
  return X_RL;
}

std::vector<std::pair<int, bool>> RobotModel::path(int from, int to) const {
  // Depth-first order: a parent's index is less than its children's, so the greater one is never the common ancestor.
  std::vector<std::pair<int, bool>> up;
  std::vector<std::pair<int, bool>> down;
  while (from != to) {
    if (from > to) {
      up.emplace_back(from, false);
      from = parent_[from];
    } else {
      down.emplace_back(to, true);
      to = parent_[to];
    }
  }
  up.insert(up.end(), down.rbegin(), down.rend());
  return up;
}

std::vector<int> RobotModel::jointsBetween(const std::string& link_a, const std::string& link_b) const {
  std::vector<int> types;
  for (const auto& step : path(indexOf(link_a), indexOf(link_b))) {
    const int type = jointAbove(step.first).type;
    if (type != urdf::Joint::FIXED) types.push_back(type);
  }
  return types;
}

bool RobotModel::rigidlyJoined(const std::string& link_a, const std::string& link_b) const {
  return jointsBetween(link_a, link_b).empty();
}

bool RobotModel::neighbours(const std::string& link_a, const std::string& link_b) const {
  const int a = indexOf(link_a), b = indexOf(link_b);
  const auto mayLieBetween = [&](int link) {
    const std::string& name = links_[static_cast<std::size_t>(link)];
    return link == a || link == b || (urdf_->getLink(name)->collision_array.empty() && unread_.count(name) == 0);
  };
  const std::vector<std::pair<int, bool>> steps = path(a, b);
  return std::all_of(steps.begin(), steps.end(), [&](const std::pair<int, bool>& step) {
    return mayLieBetween(step.first) && mayLieBetween(parent_[static_cast<std::size_t>(step.first)]);
  });
}

bool RobotModel::adjacent(const std::string& link_a, const std::string& link_b) const {
  const std::vector<std::pair<int, bool>> steps = path(indexOf(link_a), indexOf(link_b));
  if (steps.size() != 1) return false;
  const int type = jointAbove(steps[0].first).type;
  return type != urdf::Joint::FIXED && type != urdf::Joint::FLOATING && type != urdf::Joint::PLANAR;
}

double RobotModel::reach(const std::string& link_a, const Vector3d& p_A, const std::string& link_b,
                         const Vector3d& p_B) const {
  ChainReach chain(p_A);
  for (const auto& [link, down] : path(indexOf(link_a), indexOf(link_b))) {
    const urdf::Joint& joint = jointAbove(link);
    const Isometry3d X_PJ = toEigen(joint.parent_to_joint_origin_transform);
    if (down) chain.addFixed(X_PJ);
    chain.addJoint(joint, reachRange(*urdf_, joint), down);
    if (!down) chain.addFixed(X_PJ.inverse());
  }
  return chain.farthest(p_B);
}

double RobotModel::positionAt(const urdf::Joint& joint, const Isometry3d& X_PL) const {
  return jointPosition(joint, toEigen(joint.parent_to_joint_origin_transform).inverse() * X_PL);
}

}  // namespace sdf_ccd
