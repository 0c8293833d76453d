#pragma once

#include <string>
#include <vector>

#include "ros/tf/tf_history.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd {

/// The frames of a robot's links in tf.
struct RobotFrames {
  const RobotModel& robot;
  std::string prefix;  ///< empty, or ends in a slash

  std::string operator()(const std::string& link) const { return withoutLeadingSlash(prefix + link); }
  std::string operator()(int link) const { return (*this)(robot.links()[static_cast<std::size_t>(link)]); }

  /// The link that has the frame, by its index in RobotModel::links(); −1: none.
  int linkOf(const std::string& frame) const {
    const std::string found = withoutLeadingSlash(frame), begin = withoutLeadingSlash(prefix);
    return found.compare(0, begin.size(), begin) == 0 ? robot.find(found.substr(begin.size())) : -1;
  }

  /// Of all links, in the order of RobotModel::links().
  std::vector<std::string> all() const {
    std::vector<std::string> frames;
    for (const std::string& link : robot.links()) frames.push_back((*this)(link));
    return frames;
  }
};

}  // namespace sdf_ccd
