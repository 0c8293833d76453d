#pragma once

#include <memory>

#include "field/adaptive/adaptive_grid.h"
#include "sdf_ccd/field.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd {

/// An adaptive grid whose interpolation is proved to differ by at most options.max_error [m] from the distance, where
/// |φ| ≤ band. The options must be valid.
///
/// Cells are kept in the grid's own form, by block, and joined last: building takes about twice the grid's memory, or
/// three times where most cells are leaves in the place of top cells. Until it is refused it takes half as much.
/// @throws std::length_error if it would exceed options.max_bytes.
std::shared_ptr<const AdaptiveGrid> buildAdaptive(const Solid& solid, const FieldOptions& options,
                                                  const Progress& progress);

}  // namespace sdf_ccd
