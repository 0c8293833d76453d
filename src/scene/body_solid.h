#pragma once

#include <memory>

#include "scene/mesh_pool.h"
#include "sdf_ccd/body.h"
#include "surface/depth_solid.h"

namespace sdf_ccd {

/// The solid of a body's bounded elements, frame B, in which depths are measured; null where they have none that is
/// certain: of an open mesh (unless its openings are cracks), of voxels, or where faces inside it may remain.
std::shared_ptr<const DepthSolid> solidOf(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
