#pragma once

#include "scene/body_builder.h"

namespace sdf_ccd {

/// Builds, or reads from the cache, what is needed of a body; bodies and meshes of equal content once for all bodies of
/// a pool. If this fails, Body::failure says why.
BuiltBody buildBody(const BodyDescription& description, const BodyNeeds& needs, const BodyOptions& options,
                    MeshPool& pool, const Progress& progress);

/// Marks a report's body as made of another body's data, without memory of its own.
void countAsShared(BodyReport& report);

}  // namespace sdf_ccd
