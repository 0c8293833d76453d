#pragma once

#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/field/field_options.h"
#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

class ClosedSolid;
class Solid;

/// Samples the signed distance to the boundary of a mesh's solid (paper §3, Table 1): exact closest points there, signs
/// from the winding number. Where parts overlap, depth is that in all of them together (see Solid).
///
/// Uses all threads of the caller's TBB arena; the result does not depend on their number.
/// A mesh that is not closed is closed by caps (see findOpenings()): the field is that of the closed solid, and knows
/// where its surface is a cap (see DistanceField::openings()).
/// @param mesh  frame F, oriented (see orientOutward()).
/// @throws std::invalid_argument for a mesh or options that are not valid.
/// @throws std::length_error if the field would exceed options.max_bytes.
DistanceField buildField(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress = {});

/// The same for a solid that is there already.
DistanceField buildField(const Solid& solid, const FieldOptions& options, const Progress& progress = {});
DistanceField buildField(const ClosedSolid& closed, const FieldOptions& options, const Progress& progress = {});

}  // namespace sdf_ccd
