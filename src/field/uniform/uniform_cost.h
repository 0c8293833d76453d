#pragma once

#include "field/field_cost.h"
#include "geometry/solid_boundary.h"

namespace sdf_ccd {

/// What a field with cells of one size is expected to take; see expectedCost().
FieldCost expectedUniform(const Solid& solid, const FieldOptions& options);

}  // namespace sdf_ccd
