#pragma once

#include "sdf_ccd/field.h"
#include "solid/closed_solid.h"

namespace sdf_ccd {

/// The field of the solid that a mesh bounds: computed from voxels if the mesh is a boundary of voxels and the options
/// allow it (canBeLattice()), else from the triangles.
DistanceField buildField(const SolidSource& source, const FieldOptions& options, const Progress& progress = {});

}  // namespace sdf_ccd
