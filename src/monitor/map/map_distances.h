#pragma once

#include <string>

#include "monitor/proximity.h"

namespace sdf_ccd {

/// A warning that distances to be kept are below the padding of a live map [m], within which obstacles that become
/// occupied beside the robot count as its own voxels; empty if none are.
std::string distancesWithinPadding(const ProximityThresholds& thresholds, double padding);

}  // namespace sdf_ccd
