#pragma once

#include <functional>
#include <vector>

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Whether a live map's voxels are ignored where the meshes of a link or an attached object are (see VoxelMask), whose
/// fields and surface are kept for that.
bool hidesVoxels(const SceneDescription& description, const BodyDescription& body);

/// Which bodies keep the surface of their mesh (Body::surface), by index: those that hide voxels, and both of a pair of
/// which one may have its inside uncertain, so that the way to the surface decides.
/// @param isOpen  whether a body's inside is uncertain: see isInsideUncertain().
std::vector<bool> needSurface(const SceneDescription& description, const std::vector<PlannedPair>& pairs,
                              const std::function<bool(int body)>& isOpen);

}  // namespace sdf_ccd
