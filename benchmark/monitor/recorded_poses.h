#pragma once

#include <string>
#include <vector>

#include "robot_case.h"

namespace sdf_ccd::benchmark {

/// Poses of a robot's bodies in the root's frame, every `period` [s], as tf interpolates what a bag holds: per time,
/// per body. From the first time at which all bodies are known, until one no longer is, or there are `most` of them.
/// @throws std::runtime_error that names the bag, if it cannot be read or has not all bodies at one time.
std::vector<std::vector<Isometry3d>> recordedPoses(const std::string& bag, const Robot& robot, double period,
                                                   std::size_t most);

}  // namespace sdf_ccd::benchmark
