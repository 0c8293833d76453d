#include "ros/bag/recorded_positions.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include "ros/bag/read_bag.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

std::vector<JointPositions> recordedPositions(const std::string& file, const RobotModel& robot,
                                              const std::string& topic) {
  std::vector<JointPositions> states;
  readBag(file, [&] {
    rosbag::Bag bag(file);
    JointPositions positions;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (!topic.empty() && withoutLeadingSlash(message.getTopic()) != withoutLeadingSlash(topic)) continue;
      const auto joints = message.instantiate<sensor_msgs::JointState>();
      if (!joints) continue;
      bool has_changed = false;
      for (std::size_t i = 0; i < std::min(joints->name.size(), joints->position.size()); ++i) {
        if (robot.urdf().joints_.count(joints->name[i]) == 0 || !std::isfinite(joints->position[i])) continue;
        const auto [known, is_new] = positions.try_emplace(joints->name[i], joints->position[i]);
        has_changed |= is_new || known->second != joints->position[i];
        known->second = joints->position[i];
      }
      if (has_changed) states.push_back(positions);
    }
  });
  if (states.empty()) {
    throw std::runtime_error(file + ": holds no joint states of the robot's joints" +
                             (topic.empty() ? "" : " on " + topic));
  }
  return states;
}

}  // namespace sdf_ccd
