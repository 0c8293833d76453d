#pragma once

#include "field/field_cost.h"
#include "geometry/closed_solid.h"

namespace sdf_ccd {

/// The field of the solid that a mesh bounds: by its voxels, if these are known and the options allow it, else by the
/// solid.
DistanceField buildField(const SolidSource& source, const FieldOptions& options, const Progress& progress = {});

/// The expected cost of that.
FieldCost expectedCost(const SolidSource& source, const FieldOptions& options);

}  // namespace sdf_ccd
