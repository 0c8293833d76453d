#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads a mesh in the calling process, unprotected: only for the confined program sdf_ccd_read and for fuzzing. All
/// other code calls parseMesh(), which runs that program.
/// @param format  `stl`, `obj`, `off`, `ply` or `dae`.
/// @throws std::exception with the reason.
TriangleMesh parseMeshUnconfined(const std::string& bytes, const std::string& format);

}  // namespace sdf_ccd
