#pragma once

#include <string>
#include <vector>

#include "robot_case.h"

namespace sdf_ccd::benchmark {

/// Poses of a robot's bodies in the root's frame, every `period` [s], interpolated by tf from the transforms of a bag:
/// per time, per body. They begin at the first time at which all bodies are known, and end when one is not, or after
/// `most` times.
/// @throws std::runtime_error that names the bag, if it cannot be read or all bodies are never known at the same time.
std::vector<std::vector<Isometry3d>> recordedPoses(const std::string& bag, const Robot& robot, double period,
                                                   std::size_t most);

}  // namespace sdf_ccd::benchmark
