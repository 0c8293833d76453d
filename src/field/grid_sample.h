#pragma once

#include "sdf_ccd/field/adaptive_grid.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/field/sparse_grid.h"

/// What DistanceField asks of each kind of grid.
namespace sdf_ccd {

FieldSample gridSample(const SparseGrid& grid, const Vector3d& p_F);
DistanceBounds gridBounds(const SparseGrid& grid, const Vector3d& p_F);

FieldSample gridSample(const AdaptiveGrid& grid, const Vector3d& p_F);
DistanceBounds gridBounds(const AdaptiveGrid& grid, const Vector3d& p_F);

/// The sample at a place outside a grid: no nearer than the surface's box, no farther than by way of the
/// place `boundary_F` of the grid that is nearest to it.
FieldSample outsideSample(const AlignedBox3d& surface_box, const Vector3d& p_F, const Vector3d& boundary_F,
                          const FieldSample& at_boundary);

}  // namespace sdf_ccd
