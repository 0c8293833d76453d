#pragma once

#include <memory>

#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd {

/// A grid of equal cells, with samples of the distance in the bricks within the band. The options must be valid, with
/// cells or a cell_size.
/// @throws std::length_error if it would exceed options.max_bytes.
std::shared_ptr<const SparseGrid> buildUniform(const Solid& solid, const FieldOptions& options,
                                               const Progress& progress);

}  // namespace sdf_ccd
