#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads a mesh in this very process: for the program sdf_ccd_read, which is confined, and for fuzzing. All else calls
/// parseMesh(), which has that program do it.
/// @param format  `stl`, `obj`, `off`, `ply` or `dae`.
/// @throws std::exception with the reason.
TriangleMesh parseMeshHere(const std::string& bytes, const std::string& format);

}  // namespace sdf_ccd
