#include "ros/tf/joint_watch.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "common/counted.h"

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
    lines.push_back(fmt::format("{} of joint {} in {} {} not finite",
                                counted(static_cast<std::size_t>(count), "position"), name, topic,
                                count == 1 ? "is" : "are"));
  }
  if (incomplete_ > 0) {
    lines.push_back(counted(static_cast<std::size_t>(incomplete_), "message") + " of " + topic +
                    (incomplete_ == 1 ? " does" : " do") + " not give a position per name");
  }
  return lines;
}

}  // namespace sdf_ccd
