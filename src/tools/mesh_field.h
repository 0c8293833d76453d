#pragma once

#include <optional>
#include <string>

#include "field/lost_surface.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "solid/closed_solid.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd::tools {

/// Orients the mesh outward. Prints warnings about its inside to stderr, prefixed by `source`.
OrientedMesh orientWithWarning(const std::string& source, const TriangleMesh& mesh);

/// Prints what was left out of a mesh's solid and what is ambiguous about it, a line each, prefixed by `indent`. Prints
/// nothing if there is neither.
void printSolid(const SolidReport& report, const std::string& indent);

/// A field, and what it does not show of its mesh.
struct MeshField {
  DistanceField field;
  std::optional<LostSurface> lost;  ///< none for voxels whose lattice the cells fit: these are not lost
};

/// What happens to walls that are too thin for a field.
enum class ThinWalls {
  kReport,  ///< they are lost
  kKeep     ///< the cells are halved until none is, the field would exceed kMaxFieldBytes, or this takes over 10 s
};

/// Builds a field, with a progress bar of this title.
/// @throws std::length_error if it would exceed options.max_bytes or this machine's memory.
MeshField buildWithBar(const std::string& title, const SolidSource& source, FieldOptions options, ThinWalls thin_walls);

/// Prints to stderr what the field does not show, if that is noticed, prefixed by `source`.
void warnOfLost(const std::string& source, const MeshField& made);

/// The same for the mesh of a file. Prints what the field does not show.
/// @param made  of the mesh.
DistanceField buildFileField(const std::string& file, const TriangleMesh& mesh, MadeSolid& made,
                             const FieldOptions& options, ThinWalls thin_walls);

}  // namespace sdf_ccd::tools
