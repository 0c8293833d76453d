#pragma once

#include <optional>

#include "sdf_ccd/body/body.h"
#include "sdf_ccd/monitor/voxel_map.h"

namespace sdf_ccd {

/// What a body fills of a map. Empty for one that has no field where it needs one, or no bounds.
/// @param X_BM  pose of the map's frame in the body's. The mask refers to both others.
std::optional<VoxelMask> maskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM);

}  // namespace sdf_ccd
