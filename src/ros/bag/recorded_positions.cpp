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
namespace {

/// Sets the positions of mimic joints that a message does not name, though it names their leaders.
void followLeaders(const RobotModel& robot, const sensor_msgs::JointState& message,
                   const std::vector<std::string>& joints, std::vector<double>& positions) {
  JointPositions named;
  for (std::size_t i = 0; i < std::min(message.name.size(), message.position.size()); ++i)
    named[message.name[i]] = message.position[i];
  for (std::size_t j = 0; j < joints.size(); ++j) {
    const urdf::Joint& joint = *robot.urdf().getJoint(joints[j]);
    if (joint.mimic && named.count(joint.name) == 0 && named.count(robot.leader(joint).name) > 0)
      positions[j] = robot.position(joint, named);
  }
}

}  // namespace

JointStates recordedPositions(const std::string& file, const RobotModel& robot, const std::string& topic,
                              std::string& warning) {
  JointStates states;
  std::size_t not_finite = 0;
  readBag(file, [&] {
    rosbag::Bag bag(file);
    std::map<std::string, std::size_t> indices;  // in states.joints
    std::vector<double> positions;
    for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
      if (!topic.empty() && withoutLeadingSlash(message.getTopic()) != withoutLeadingSlash(topic)) continue;
      const auto joints = messageOf<sensor_msgs::JointState>(message);
      if (!joints) continue;
      const std::size_t count = std::min(joints->name.size(), joints->position.size());
      const auto isRobots = [&](std::size_t i) { return robot.urdf().joints_.count(joints->name[i]) != 0; };
      bool has_changed = false, is_finite = true;
      for (std::size_t i = 0; i < count; ++i) is_finite &= std::isfinite(joints->position[i]) || !isRobots(i);
      if (!is_finite) {
        ++not_finite;
        continue;
      }
      for (std::size_t i = 0; i < count; ++i) {
        if (!isRobots(i)) continue;
        const auto [index, is_new] = indices.try_emplace(joints->name[i], positions.size());
        if (is_new) {
          states.joints.push_back(joints->name[i]);
          positions.push_back(0.0);
        }
        double& position = positions[index->second];
        has_changed |= is_new || position != joints->position[i];
        position = joints->position[i];
      }
      if (!has_changed) continue;
      followLeaders(robot, *joints, states.joints, positions);
      states.positions.push_back(positions);
    }
  });
  const std::string left_out = std::to_string(not_finite) + " joint states with positions that are not finite";
  if (states.size() == 0) {
    throw std::runtime_error(file + ": contains no joint states of the robot's joints" +
                             (topic.empty() ? "" : " on " + topic) + (not_finite > 0 ? ", only " + left_out : ""));
  }
  if (not_finite > 0) warning = file + ": " + left_out + " are left out";
  return states;
}

}  // namespace sdf_ccd
