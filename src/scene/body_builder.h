#pragma once

#include <memory>

#include "scene/body_surface.h"
#include "scene/mesh_pool.h"
#include "sdf_ccd/body.h"

namespace sdf_ccd {

/// Whether its geometry is not primitives alone.
bool hasMesh(const BodyDescription& body);

/// Why no shell can cover the body's surface; empty if one can.
std::string whyNoShell(const BodyDescription& body);

struct BuiltBody {
  Body body;
  BodyReport report;
  bool exceeds_limit = false;  ///< Body::failure: a field or shell is too large
};

/// Builds, or reads from the cache, field and shell of a body, as far as they are needed. If this fails,
/// Body::failure says why.
///
/// Shell points deeper inside a sibling part than the covering radius are left out. The radius stays
/// valid for the union: a location q of its surface is outside the sibling, so (distances being
/// 1-Lipschitz) the nearest point to q is no deeper in it than the radius, and is kept. Kept points
/// inside a sibling have no area. Siblings that are meshes count only if their field is built and their
/// sign is reliable.
BuiltBody buildUnshared(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                        MeshPool& pool, const Progress& progress);

/// A body that cannot be checked for this reason.
BuiltBody failedBody(const BodyDescription& description, const std::string& failure);

/// The triangles of a body's geometry; null if it has none.
std::shared_ptr<const BodySurface> surfaceOf(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
