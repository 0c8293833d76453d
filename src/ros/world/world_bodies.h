#pragma once

#include <string>
#include <vector>

#include "ros/parameters/parameters.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Why an object cannot have this name; empty if it can.
std::string whyNoName(const std::string& name);

/// Placeholder for a live map that has not been received yet: the robot is NOT_CHECKED against it, for this reason, and
/// its bodies are prepared for it.
BodyDescription awaitedTile(const std::string& frame, const std::string& why);

}  // namespace sdf_ccd
