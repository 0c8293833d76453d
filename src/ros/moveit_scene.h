#pragma once

#include <string>
#include <vector>

#include "ros/world_object.h"

namespace sdf_ccd {

/// MoveIt's text of a planning scene: objects of boxes, spheres, cylinders, planes and meshes, as it is now, with a
/// pose of each object and its subframes (which are passed over), or as it was before Noetic. Cones and OctoMaps are
/// refused.
/// @throws std::runtime_error with the line and the reason.
std::vector<WorldObject> parseMoveitScene(const std::string& text);

}  // namespace sdf_ccd
