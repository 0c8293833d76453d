#pragma once

#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Whether a live map's voxels are ignored where the meshes of a link or an attached object are (see VoxelMask), whose
/// fields and surface are kept for that.
bool hidesVoxels(const SceneDescription& description, const BodyDescription& body);

/// Whether the body keeps the surface of its mesh (Body::surface): if it hides voxels, or is an object that a live map
/// may show.
bool needsSurface(const SceneDescription& description, const BodyDescription& body);

}  // namespace sdf_ccd
