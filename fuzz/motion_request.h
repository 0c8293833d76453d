#pragma once

#include "small_monitor.h"

namespace sdf_ccd::fuzz {

/// A request about one motion; its numbers may be anything that a message can hold.
inline QueryMotion::Request motionRequestOf(Numbers& numbers) {
  QueryMotion::Request request;
  const std::size_t what = numbers.byte();
  request.allow_beyond_limits = (what & 1) != 0;
  ros::Duration time;
  // Mostly up to 4 s after the previous time; sometimes any value that a message can hold.
  const auto nextTime = [&] {
    time += ros::Duration(numbers.below(4), 1000000 * numbers.byte());
    return numbers.below(32) > 0
               ? time
               : ros::Duration(static_cast<std::int32_t>(numbers.byte() * 0x01010101U), numbers.byte() * 3900000);
  };
  if (what & 2) {
    for (std::size_t i = numbers.below(4); i > 0; --i)
      request.motion.joint_trajectory.joint_names.push_back(nameOf(numbers));
    request.motion.joint_trajectory.points.resize(numbers.below(5));
    for (auto& point : request.motion.joint_trajectory.points) {
      point.time_from_start = nextTime();
      const std::size_t count =
          numbers.below(16) == 0 ? numbers.below(4) : request.motion.joint_trajectory.joint_names.size();
      for (std::size_t i = 0; i < count; ++i) point.positions.push_back(numbers.real());
    }
  }
  if (what & 4) {
    auto& poses = request.motion.multi_dof_joint_trajectory;
    poses.header.frame_id = nameOf(numbers);
    for (std::size_t i = numbers.below(3); i > 0; --i) poses.joint_names.push_back(nameOf(numbers));
    poses.points.resize(numbers.below(5));
    for (auto& point : poses.points) {
      point.time_from_start = nextTime();
      point.transforms.resize(numbers.below(16) == 0 ? numbers.below(4) : poses.joint_names.size());
      for (auto& transform : point.transforms) takePose(numbers, transform.rotation, transform.translation);
    }
  }
  for (std::size_t i = what & 8 ? numbers.below(3) : 0; i > 0; --i) {
    request.motion.other_joints.name.push_back(nameOf(numbers));
    request.motion.other_joints.position.push_back(numbers.real());
  }
  if (what & 16) {
    LinkTrajectory& links = request.motion.link_trajectory;
    for (std::size_t i = numbers.below(3); i > 0; --i) links.link_names.push_back(nameOf(numbers));
    links.points.resize(numbers.below(5));
    for (auto& point : links.points) {
      point.time_from_start = nextTime();
      point.poses.resize(numbers.below(16) == 0 ? numbers.below(4) : links.link_names.size());
      for (auto& pose : point.poses) takePose(numbers, pose.orientation, pose.position);
    }
  }
  return request;
}

}  // namespace sdf_ccd::fuzz
