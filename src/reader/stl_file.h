#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads text and binary STL. A binary file may begin with `solid`, and may have bytes after its last triangle.
/// @throws std::runtime_error with the reason: neither text nor binary, shorter than the announced triangles need, or
/// text that ends before its last `endsolid`.
TriangleMesh parseStl(const std::string& bytes);

}  // namespace sdf_ccd
