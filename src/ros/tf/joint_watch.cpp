#include "ros/tf/joint_watch.h"

#include <algorithm>
#include <cmath>

namespace sdf_ccd {

JointWatch::JointWatch(const RobotModel& robot) {
  for (const auto& [name, joint] : robot.urdf().joints_) counts_[name] = 0;
}

void JointWatch::add(const sensor_msgs::JointState& joints) {
  const std::size_t positions = std::min(joints.name.size(), joints.position.size());
  if (positions > 0 && joints.position.size() != joints.name.size()) {  // a message of velocities has none
    const std::lock_guard<std::mutex> lock(mutex_);
    incomplete_ += std::any_of(joints.name.begin(), joints.name.end(),
                               [&](const std::string& name) { return counts_.count(name) > 0; });
  }
  for (std::size_t i = 0; i < positions; ++i) {
    if (std::isfinite(joints.position[i])) continue;
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto joint = counts_.find(joints.name[i]);
    if (joint == counts_.end()) continue;
    ++joint->second;
  }
}

std::vector<std::string> JointWatch::lines(const std::string& topic) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::string> lines;
  for (const auto& [name, count] : counts_) {
    if (count == 0) continue;
    lines.push_back(std::to_string(count) + (count == 1 ? " position" : " positions") + " of joint " + name + " in " +
                    topic + (count == 1 ? " is not finite" : " are not finite"));
  }
  if (incomplete_ > 0) {
    lines.push_back(std::to_string(incomplete_) + (incomplete_ == 1 ? " message" : " messages") + " of " + topic +
                    (incomplete_ == 1 ? " does" : " do") + " not give a position per name");
  }
  return lines;
}

}  // namespace sdf_ccd
