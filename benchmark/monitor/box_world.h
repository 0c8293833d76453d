#pragma once

#include <cstdint>
#include <vector>

#include "monitor/robot_motion.h"

namespace sdf_ccd::benchmark {

/// A robot moving among boxes.
struct BoxWorld {
  SceneDescription scene;  ///< the robot's bodies, then the boxes
  RobotMotion motion;
  std::size_t touching;  ///< pairs of the robot's bodies that touch in it
};

/// Minimum distance of the boxes from the robot over its motion, measured with FCL at many poses.
enum class Proximity {
  kClear,       ///< 3 to 20 cm
  kNear,        ///< every second box 1 to 10 mm, the others as for kClear
  kContact,     ///< every fifth box 2 to 20 mm deep, the others as for kClear
  kPersistent,  ///< as for kClear, and the pairs of the robot's bodies that touch all the time are checked
};

/// Twenty boxes around a robot that moves for `seconds`. Of several motions, the one with the fewest self-collisions is
/// chosen; the pairs of the robot's bodies that touch in it are allowed to collide and not checked, but for
/// kPersistent.
BoxWorld makeBoxWorld(const Robot& robot, Proximity proximity, double seconds, std::uint64_t seed);

/// The same for given poses of the robot. Returns the robot's bodies, then the boxes.
/// @param poses  per time, per body of the robot's scene, in the root's frame.
SceneDescription boxesAbout(const Robot& robot, const std::vector<std::vector<Isometry3d>>& poses, Proximity proximity,
                            std::uint64_t seed);

}  // namespace sdf_ccd::benchmark
