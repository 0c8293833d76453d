#pragma once

#include <vector>

#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// The grid about a surface in this box for options that have cells or a cell_size.
/// @throws std::length_error if it would have too many cells along one side.
GridShape uniformShape(const AlignedBox3d& surface_box, const FieldOptions& options);

/// Smallest |φ| at a brick's corners [m]. @param corners  of all bricks, ordered as cornerIndex().
double nearestCorner(const GridShape& shape, const std::vector<float>& corners, const Vector3i& brick);

/// @throws std::length_error if `bytes` exceeds options.max_bytes; the message names the cell size that would fit.
void requireBytes(std::size_t bytes, const GridShape& shape, const FieldOptions& options);

}  // namespace sdf_ccd
