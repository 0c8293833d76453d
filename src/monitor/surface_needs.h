#pragma once

#include <functional>
#include <vector>

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Which bodies keep the surface of their mesh (Body::surface), by index: both of a pair of which one may have its
/// inside uncertain, so that the way to the surface decides, and links beside a live map, whose own voxels are ignored
/// (see VoxelMask).
/// @param isOpen  whether a body's inside is uncertain: see isInsideUncertain().
std::vector<bool> needSurface(const SceneDescription& description, const std::vector<PlannedPair>& pairs,
                              const std::function<bool(int body)>& isOpen);

}  // namespace sdf_ccd
