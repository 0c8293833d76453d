#include "robot/joint_sampler.h"

#include <algorithm>
#include <cmath>

#include "joint_kind.h"

namespace sdf_ccd {
namespace {

constexpr std::uint64_t kAtLimits = 4;  // every fourth state

}  // namespace

JointSampler::JointSampler(const RobotModel& robot, std::uint64_t seed) : random_(seed) {
  for (std::size_t link = 1; link < robot.links().size(); ++link) {
    const urdf::Joint& joint = robot.jointAbove(static_cast<int>(link));
    if (joint.mimic) continue;
    if (hasLimits(joint) && hasPosition(joint)) {
      joints_.push_back({joint.name, joint.limits->lower, joint.limits->upper, true});
    } else if (rotates(joint)) {
      joints_.push_back({joint.name, -M_PI, M_PI, false});
      if (joint.type == urdf::Joint::REVOLUTE) without_limits_.push_back(joint.name);
    }
  }
}

bool JointSampler::isUnbounded(const RobotModel& robot, const urdf::Joint& joint) {
  const urdf::Joint& leader = robot.leader(joint);
  return joint.type == urdf::Joint::PLANAR || joint.type == urdf::Joint::FLOATING ||
         (leader.type == urdf::Joint::PRISMATIC && !hasLimits(leader));
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
