#pragma once

#include <string>

#include "geometry/closed_solid.h"
#include "geometry/solid_boundary.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/field/distance_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"

namespace sdf_ccd::tools {

/// Orients the mesh outward. Prints warnings about its inside to stderr, prefixed by `source`.
OrientedMesh orientWithWarning(const std::string& source, const TriangleMesh& mesh);

/// Prints what was left out of a mesh's solid and what is ambiguous about it, a line each, prefixed by `indent`. Prints
/// nothing if there is neither.
void printSolid(const SolidReport& report, const std::string& indent);

/// Builds a field, with a progress bar of this title.
DistanceField buildWithBar(const std::string& title, const SolidSource& source, const FieldOptions& options);

/// Builds the field of a mesh from a file, with a progress bar. Prints the expected cost first if that is more than a
/// second.
/// @param made  of the mesh.
/// @throws std::length_error beyond the monitor's limits, with a setting that would fit, before anything is built.
DistanceField buildAffordable(const std::string& file, const TriangleMesh& mesh, MadeSolid& made,
                              const FieldOptions& options);

}  // namespace sdf_ccd::tools
