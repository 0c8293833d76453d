#pragma once

#include <string>
#include <vector>

#include "ros/parameters/parameters.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// Why no object may have this name; empty if one may.
std::string whyNoName(const std::string& name);

/// An object's body in a tf frame. If it cannot be made, BodyDescription::failure says why.
/// @param warnings  get what else is to be known.
BodyDescription toBody(const WorldObject& object, const std::string& frame, const ResourceLoader& loader,
                       std::vector<std::string>& warnings);

/// The same of an OctoMap's file: a body of that name.
BodyDescription toBody(const std::string& name, const OctomapObject& octomap, const std::string& frame);

/// Stands for a live map while there is none: the robot is NOT_CHECKED against it, for this reason, and prepared for it.
BodyDescription awaitedTile(const std::string& frame, const std::string& why);

}  // namespace sdf_ccd
