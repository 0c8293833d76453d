#pragma once

#include "field/field_cost.h"
#include "geometry/solid_boundary.h"

namespace sdf_ccd {

/// The expected cost of buildAdaptive(); see expectedCost().
FieldCost expectedAdaptive(const Solid& solid, const FieldOptions& options);

}  // namespace sdf_ccd
