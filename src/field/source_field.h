#pragma once

#include "field/field_cost.h"
#include "geometry/closed_solid.h"

namespace sdf_ccd {

/// The field of what a mesh bounds: by its voxels, where these are known and the options let it, else by the closed
/// solid.
DistanceField buildField(const SolidSource& source, const FieldOptions& options, const Progress& progress = {});

/// What that is expected to take.
FieldCost expectedCost(const SolidSource& source, const FieldOptions& options);

}  // namespace sdf_ccd
