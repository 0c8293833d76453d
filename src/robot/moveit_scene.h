#pragma once

#include <string>
#include <vector>

#include "robot/world_shapes.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Parses MoveIt's text format of a planning scene: objects made of boxes, spheres, cylinders, cones, planes and
/// meshes, in the present format, with a pose of each object and its subframes (which are ignored), or in the format
/// before Noetic. OctoMaps are rejected.
/// @throws std::runtime_error with the line and the reason.
std::vector<WorldObject> parseMoveitScene(const std::string& text);

/// Whether a name is read back as it was written: readers take the line without the blanks around it.
bool isSavedName(const std::string& name);

/// The text of bodies in one frame, in the present format; numbers are written so that they are read back exactly.
/// @throws std::invalid_argument for a name that would be read back differently.
std::string moveitScene(const std::vector<BodyDescription>& bodies);

}  // namespace sdf_ccd
