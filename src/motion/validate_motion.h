#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sdf_ccd/trajectory.h"

namespace sdf_ccd {

/// The requirements on a motion.
struct MotionShape {
  std::vector<std::string> bodies;       ///< names, for messages
  std::vector<bool> without_poses = {};  ///< per body: whether it may have none; empty if all need them
  std::size_t pairs = 0;
};

/// @throws std::invalid_argument, beginning with `what`, unless there are two increasing, finite times or more from 0
/// on; as many poses of each body as times, except for missing ones; and spans, missing bodies and motion errors
/// that match, or none. Poses are not read, and nothing is allocated if all is valid.
void validate(const CycleMotion& motion, const MotionShape& shape, const char* what);

}  // namespace sdf_ccd
