#pragma once

#include "field/adaptive/adaptive_grid.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"

/// DistanceField's queries of each kind of grid, at points within its box.
namespace sdf_ccd {

FieldSample sampleWithin(const SparseGrid& grid, const Vector3d& p_F);
FieldValue interpolateWithin(const SparseGrid& grid, const Vector3d& p_F);
DistanceBounds boundsWithin(const SparseGrid& grid, const Vector3d& p_F);

FieldSample sampleWithin(const AdaptiveGrid& grid, const Vector3d& p_F);
FieldValue interpolateWithin(const AdaptiveGrid& grid, const Vector3d& p_F);
DistanceBounds boundsWithin(const AdaptiveGrid& grid, const Vector3d& p_F);

}  // namespace sdf_ccd
