#pragma once

#include <string>

#include "sdf_ccd/body.h"

namespace sdf_ccd {

constexpr const char* kLiveMap = "octomap";  ///< name of the live map; its tiles are named "octomap/x_y_z"

/// Placeholder for a live map that has not been received yet: the robot is NOT_CHECKED against it, for this reason, and
/// its bodies are prepared for it.
BodyDescription awaitedTile(const std::string& frame, const std::string& why);

/// @param tiles_begin  prefix of the names of a live map's tiles; empty: there is none.
/// @throws std::invalid_argument if the body's name is reserved for them.
void requireNoTile(const std::string& body, const std::string& tiles_begin);

}  // namespace sdf_ccd
