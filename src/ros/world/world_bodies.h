#pragma once

#include <string>
#include <vector>

#include "ros/parameters/parameters.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// Why an object cannot have this name; empty if it can.
std::string whyNoName(const std::string& name);

/// Body of an OctoMap file in a tf frame, with the given name. If it cannot be made, BodyDescription::failure says why.
BodyDescription toBody(const std::string& name, const OctomapObject& octomap, const std::string& frame,
                       const ResourceLoader& loader);

/// Placeholder for a live map that has not been received yet: the robot is NOT_CHECKED against it, for this reason, and
/// its bodies are prepared for it.
BodyDescription awaitedTile(const std::string& frame, const std::string& why);

}  // namespace sdf_ccd
