#pragma once

#include <string>

#include "sdf_ccd/common/eigen_types.h"

namespace sdf_ccd {

/// Of a map's tile, by its place in steps of tiles from the map's origin: "map/x_y_z".
std::string tileName(const std::string& map, const Vector3i& place);

/// The name of the map that a body of such a name is a tile of; the body's own of another.
std::string mapOfTile(const std::string& body);

}  // namespace sdf_ccd
