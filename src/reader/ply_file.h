#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads PLY, text or binary in either byte order: the elements `vertex` (x, y, z), `face` and `tristrips`
/// (vertex_indices or vertex_index); others are skipped.
/// @throws std::runtime_error with the reason, also if the file holds fewer elements than its header announces.
TriangleMesh parsePly(const std::string& bytes);

}  // namespace sdf_ccd
