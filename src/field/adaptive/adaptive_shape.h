#pragma once

#include "field/adaptive/adaptive_grid.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// The grid about a surface in this box for options that have a max_error, which becomes the grid's error bound.
/// @throws std::length_error if the band is too wide for it.
AdaptiveShape adaptiveShape(const AlignedBox3d& surface_box, const FieldOptions& options);

}  // namespace sdf_ccd
