#pragma once

#include <optional>

#include "sdf_ccd/body/body.h"
#include "sdf_ccd/monitor/scene.h"
#include "voxel_map.h"

namespace sdf_ccd {

/// The part of a map that a body fills, as a mask. Empty if the body has no bounded geometry whose distance is known.
/// @param body  if hidesVoxels(), with its surface, without which the mask may be far too large.
/// @param X_BM  pose of the map's frame in the body's. The mask refers to `body` and `description`.
std::optional<VoxelMask> maskOf(const Body& body, const BodyDescription& description, const Isometry3d& X_BM);

/// Whether voxels of a map are ignored where this body is: a link, or an attached object, beside a map.
bool hidesVoxels(const SceneDescription& description, std::size_t body);

/// Masks of the scene's links hide voxels up to this distance, if the padding is smaller [m]: twice the fields' error,
/// within which they cannot tell the inside from the outside.
double maskError(const Scene& scene);

}  // namespace sdf_ccd
