#pragma once

#include <string>
#include <vector>

#include "robot/world_shapes.h"

namespace sdf_ccd {

/// Loads a world from a file: YAML (`.yaml`, `.yml`) with a parameter `world` as for readWorld(), or MoveIt's text
/// format as for parseMoveitScene() (`.scene`).
/// @throws std::runtime_error with the file and the reason, and the line where known; also for other extensions.
std::vector<WorldObject> loadWorldFile(const std::string& file);

/// The same from a file's content. @param file  its name, whose ending gives the format.
std::vector<WorldObject> parseWorldFile(const std::string& text, const std::string& file);

}  // namespace sdf_ccd
