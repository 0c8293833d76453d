#pragma once

#include <string>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Reads a mesh in the calling process, unprotected: only for the confined program sdf_ccd_read and for fuzzing. All
/// other code calls parseMesh(), which runs that program.
/// @param format  `stl`, `obj`, `ply` or `off`.
/// @throws std::exception with the reason.
TriangleMesh parseMeshUnconfined(const std::string& bytes, const std::string& format);

/// The mesh of a file with its equal vertices joined. @throws std::invalid_argument if it is not valid.
TriangleMesh finishedMesh(const TriangleMesh& mesh);

/// Some editors write a byte order mark before a text.
std::string withoutByteOrderMark(const std::string& bytes);

}  // namespace sdf_ccd
