#include "ros/bag/recorded_positions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include <rosbag/view.h>
#include <sensor_msgs/JointState.h>

#include "ros/bag/read_bag.h"
#include "ros/tf/tf_history.h"

namespace sdf_ccd {

JointStates recordedPositions(const std::string& file, const RobotModel& robot, const std::string& topic) {
  JointStates states;
  readBag(file, [&] {
    rosbag::Bag bag(file);
    std::map<std::string, std::size_t> indices;  // in states.joints
    std::vector<double> positions;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (!topic.empty() && withoutLeadingSlash(message.getTopic()) != withoutLeadingSlash(topic)) continue;
      const auto joints = message.instantiate<sensor_msgs::JointState>();
      if (!joints) continue;
      bool has_changed = false;
      for (std::size_t i = 0; i < std::min(joints->name.size(), joints->position.size()); ++i) {
        if (robot.urdf().joints_.count(joints->name[i]) == 0 || !std::isfinite(joints->position[i])) continue;
        const auto [index, is_new] = indices.try_emplace(joints->name[i], positions.size());
        if (is_new) {
          states.joints.push_back(joints->name[i]);
          positions.push_back(0.0);
        }
        double& position = positions[index->second];
        has_changed |= is_new || position != joints->position[i];
        position = joints->position[i];
      }
      if (has_changed) states.positions.push_back(positions);
    }
  });
  if (states.size() == 0) {
    throw std::runtime_error(file + ": contains no joint states of the robot's joints" +
                             (topic.empty() ? "" : " on " + topic));
  }
  return states;
}

}  // namespace sdf_ccd
