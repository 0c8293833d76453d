#pragma once

#include <string>

#include "ros/parameters/parameters.h"

namespace sdf_ccd {

/// A warning that distances to be kept are below the padding of a live map, within which obstacles that become occupied
/// beside the robot are taken for its own voxels; empty if none are, or there is no live map.
std::string distancesWithinPadding(const MonitorParameters& parameters);

}  // namespace sdf_ccd
