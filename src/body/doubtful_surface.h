#pragma once

#include <memory>

#include "body/mesh_pool.h"
#include "geometry/triangle_tree.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// See Body::doubtful. Null where what is inside the body's meshes is certain, but for openings.
std::shared_ptr<const TriangleTree> doubtfulSurface(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
