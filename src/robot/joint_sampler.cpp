#include "robot/joint_sampler.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "joint_kind.h"

namespace sdf_ccd {
namespace {

constexpr std::uint64_t kAtLimits = 4;  // every fourth state

/// How far a joint's leader has to rotate on both sides of 0 [rad] for the joint to take all its positions, or all that
/// its limits hold.
double halfRange(const RobotModel& robot, const urdf::Joint& joint, const std::string& leader) {
  constexpr double kMany = 100.0 * M_PI;  // in which joints at other rates have been in almost all states together
  constexpr double kMost = 1e9;           // angles beyond lose their digits
  const double rate = std::abs(robot.multiplier(joint));
  double half = M_PI;
  if (rate == 0.0) return half;
  if (rotates(joint)) {
    if (rate != std::round(rate)) half = std::max(kMany, M_PI / rate);
  } else if (hasPosition(joint) && hasLimits(joint)) {
    const double offset = robot.position(joint, {{leader, 0.0}});
    half = std::max(std::abs(joint.limits->lower - offset), std::abs(joint.limits->upper - offset)) / rate;
  }
  return std::min(half, kMost);
}

/// The largest of those that follow a joint; by its name.
std::map<std::string, double> halfRanges(const RobotModel& robot) {
  std::map<std::string, double> ranges;
  for (std::size_t link = 1; link < robot.links().size(); ++link) {
    const urdf::Joint& joint = robot.jointAbove(static_cast<int>(link));
    if (!joint.mimic) continue;
    const std::string& leader = robot.leader(joint).name;
    double& half = ranges[leader];
    half = std::max(half, halfRange(robot, joint, leader));
  }
  return ranges;
}

}  // namespace

JointSampler::JointSampler(const RobotModel& robot, std::uint64_t seed) : random_(seed) {
  const std::map<std::string, double> of_followers = halfRanges(robot);
  for (std::size_t link = 1; link < robot.links().size(); ++link) {
    const urdf::Joint& joint = robot.jointAbove(static_cast<int>(link));
    if (joint.mimic) continue;
    if (hasLimits(joint) && hasPosition(joint)) {
      joints_.push_back({joint.name, joint.limits->lower, joint.limits->upper, true});
    } else if (rotates(joint)) {
      const auto found = of_followers.find(joint.name);
      const double half = found == of_followers.end() ? M_PI : std::max(M_PI, found->second);
      joints_.push_back({joint.name, -half, half, false});
      if (joint.type == urdf::Joint::REVOLUTE) without_limits_.push_back(joint.name);
    }
  }
}

bool JointSampler::isUnbounded(const RobotModel& robot, const urdf::Joint& joint) {
  const urdf::Joint& leader = robot.leader(joint);
  const bool slides = joint.type == urdf::Joint::PRISMATIC && !hasLimits(joint);
  return joint.type == urdf::Joint::PLANAR || joint.type == urdf::Joint::FLOATING ||
         (!hasLimits(leader) && (leader.type == urdf::Joint::PRISMATIC || (slides && rotates(leader))));
}

std::string JointSampler::unboundedBetween(const RobotModel& robot, int link_a, int link_b) {
  while (link_a != link_b) {
    int& lower = link_a > link_b ? link_a : link_b;  // depth-first order: the greater index is no ancestor
    const urdf::Joint& joint = robot.jointAbove(lower);
    if (joint.type != urdf::Joint::FIXED && isUnbounded(robot, joint)) return joint.name;
    lower = robot.parent(lower);
  }
  return "";
}

JointPositions JointSampler::next() {
  const bool at_limits = ++count_ % kAtLimits == 0;
  JointPositions positions;
  for (const Joint& joint : joints_) {
    double share = uniform();
    if (at_limits && joint.has_limits && uniform() < 0.5) share = share < 0.5 ? 0.0 : 1.0;
    positions[joint.name] = share == 1.0 ? joint.upper : joint.lower + share * (joint.upper - joint.lower);
  }
  return positions;
}

double JointSampler::uniform() {
  return double(random_() >> 11) * 0x1.0p-53;
}

}  // namespace sdf_ccd
