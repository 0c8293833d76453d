#pragma once

#include <cstddef>
#include <limits>

namespace sdf_ccd {

/// How closely samples follow a motion whose twists are not constant.
struct MotionSampling {
  double tolerance = 1e-4;  ///< deviation aimed at [m]
  int max_halvings = 5;     ///< of the time between two waypoints; what deviation is left then is reported
  /// Of all sampled bodies together; with this many, no more times are halved.
  std::size_t max_poses = std::numeric_limits<std::size_t>::max();
};

}  // namespace sdf_ccd
