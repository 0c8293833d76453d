#pragma once

#include "field/field_cost.h"
#include "geometry/solid_boundary.h"

namespace sdf_ccd {

/// The expected cost of a field with cells of one size; see expectedCost().
FieldCost expectedUniform(const Solid& solid, const FieldOptions& options);

}  // namespace sdf_ccd
