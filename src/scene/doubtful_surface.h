#pragma once

#include <memory>

#include "mesh/triangle_tree.h"
#include "scene/mesh_pool.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// See Body::doubtful and Body::inside_is_doubtful.
struct Doubt {
  std::shared_ptr<const TriangleTree> of_outside;
  bool of_inside = false;
};

Doubt doubtOf(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
