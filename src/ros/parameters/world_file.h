#pragma once

#include <string>
#include <vector>

#include "ros/parameters/world_object.h"

namespace sdf_ccd {

/// A world in a file: YAML (`.yaml`, `.yml`) that holds `world` as readWorld() takes it, or parseMoveitScene()'s text
/// (`.scene`).
/// @throws std::runtime_error with the file and the reason, and the line where known; for other endings too.
std::vector<WorldObject> loadWorldFile(const std::string& file);

}  // namespace sdf_ccd
