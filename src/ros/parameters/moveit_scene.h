#pragma once

#include <string>
#include <vector>

#include "ros/parameters/world_object.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// MoveIt's text of a planning scene: objects of boxes, spheres, cylinders, planes and meshes, as it is now, with a
/// pose of each object and its subframes (which are passed over), or as it was before Noetic. Cones and OctoMaps are
/// refused.
/// @throws std::runtime_error with the line and the reason.
std::vector<WorldObject> parseMoveitScene(const std::string& text);

/// Whether a name is read as it was written: readers take the line without the blanks around it.
bool isSavedName(const std::string& name);

/// That text of bodies in one frame, as it is now; numbers so that they are read again as they were.
/// @throws std::invalid_argument for a name that would be read as another.
std::string moveitScene(const std::vector<BodyDescription>& bodies);

}  // namespace sdf_ccd
