#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads STL: binary also where it begins with `solid` or has bytes after its last triangle, and text.
/// @throws std::runtime_error with the reason: neither, shorter than the triangles it announces, or text that ends
/// before its last `endsolid`.
TriangleMesh parseStl(const std::string& bytes);

}  // namespace sdf_ccd
