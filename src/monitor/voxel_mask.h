#pragma once

#include <optional>

#include "sdf_ccd/body/body.h"
#include "voxel_map.h"

namespace sdf_ccd {

/// The part of a map that a body fills, as a mask. Empty if the body has no bounded geometry whose distance is known.
/// @param X_BM  pose of the map's frame in the body's. The mask refers to `body` and `description`.
std::optional<VoxelMask> maskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM);

}  // namespace sdf_ccd
