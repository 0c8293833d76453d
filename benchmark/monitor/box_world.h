#pragma once

#include <cstdint>
#include <vector>

#include "monitor/robot_motion.h"

namespace sdf_ccd::benchmark {

/// A robot that moves among boxes.
struct BoxWorld {
  SceneDescription scene;  ///< the robot's bodies, then the boxes
  RobotMotion motion;
};

/// How near boxes come to the robot over all of its motion, by FCL at many times of it.
enum class Proximity {
  kClear,    ///< 3 to 20 cm
  kNear,     ///< half of them 1 to 10 mm, the others as if clear
  kContact,  ///< every fifth 2 to 20 mm deep, the others as if clear
};

/// Twenty boxes about a robot that moves for `seconds`. Pairs of its own bodies that touch on the way are disabled. Of
/// several motions, the one with the fewest of those.
BoxWorld makeBoxWorld(const Robot& robot, Proximity proximity, double seconds, std::uint64_t seed);

/// The same of a robot that was there at some times: its bodies, then the boxes.
/// @param poses  per time, per body of the robot's scene, in the root's frame.
SceneDescription boxesAbout(const Robot& robot, const std::vector<std::vector<Isometry3d>>& poses, Proximity proximity,
                            std::uint64_t seed);

}  // namespace sdf_ccd::benchmark
