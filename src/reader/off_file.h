#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads OFF as text, with or without colours, normals and texture coordinates. Not: binary OFF, vertices of other than
/// three coordinates.
/// @throws std::runtime_error with the reason, also if there is less than the header announces.
TriangleMesh parseOff(const std::string& bytes);

}  // namespace sdf_ccd
