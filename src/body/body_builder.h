#pragma once

#include <memory>

#include "body/body_surface.h"
#include "body/mesh_pool.h"
#include "sdf_ccd/body/body.h"
#include "sdf_ccd/model/scene_description.h"

namespace sdf_ccd {

/// What of a body is to be made.
struct BodyNeeds {
  bool field = true;
  bool shell = true;
  bool edges_only = false;  ///< the body is one box, of whose shell no pair needs more
  bool decides = true;      ///< some verdict rests on the shell: no primitive's may have fewer points, if it is large
  bool witnesses = false;

  bool any() const { return field || shell || witnesses; }
};

/// Why no shell can cover the body's surface; empty if one can.
std::string whyNoShell(const BodyDescription& body);

/// Whether it has no shell, for the sake of its voxels or half-spaces, and yet some geometry that may lie wholly inside
/// another body, in many pieces.
bool needsWitnesses(const BodyDescription& body);

struct BuiltBody {
  Body body;
  BodyReport report;
};

/// Builds, or takes from the cache, what is needed of a body; meshes of equal content once for all bodies of a pool. If
/// that cannot be, Body::failure says why. Body::surface is left out: see surfaceOf().
///
/// Shell points deeper inside a sibling part than the covering radius are left out. The radius stays true for the
/// union: a location q of its surface is outside the sibling, so (distances being 1-Lipschitz) the point nearest to q
/// is no deeper in it than the radius, and kept. Kept points inside a sibling stand for no area. Siblings that are
/// meshes count only where their field is built and their sign is trusted.
/// @param progress  called with the share of the body's fields done.
BuiltBody buildBody(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                    MeshPool& pool, const Progress& progress);

/// The triangles of a body's geometry; null where it has none.
std::shared_ptr<const BodySurface> surfaceOf(const BodyDescription& description, MeshPool& pool);

}  // namespace sdf_ccd
