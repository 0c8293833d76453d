#pragma once

#include <optional>
#include <string>

#include "mesh_field.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::tools {

/// A mesh file, and what is to be made of it.
struct MeshBuild {
  std::string name;  ///< of the files, without ending
  TriangleMesh mesh;
  double voxel_size = 0.0;  ///< of the OctoMap whose surface the mesh is [m]; 0: a mesh of any quality
  FieldOptions field;       ///< exactly one resolution
  ThinWalls thin_walls = ThinWalls::kReport;  ///< kKeep only if field.cells is set
  std::optional<double> spacing;              ///< of the shell's points [m]; if not set, two cells of a uniform grid
};

/// Writes NAME.field and, unless the mesh is a voxel surface, NAME.shell, and reports on both. The components of a
/// mesh are oriented outward; existing files are overwritten.
/// @param directory  made if it does not exist.
/// @throws std::length_error if field or shell would be too large, and no file is written; std::runtime_error if the
/// directory cannot be written to.
void buildMesh(MeshBuild build, const std::string& directory);

}  // namespace sdf_ccd::tools
