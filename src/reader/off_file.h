#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads text OFF, with or without colours, normals and texture coordinates. Binary OFF, and vertices of other than
/// three coordinates, are refused.
/// @throws std::runtime_error with the reason, also if the file holds fewer elements than its header announces.
TriangleMesh parseOff(const std::string& bytes);

}  // namespace sdf_ccd
