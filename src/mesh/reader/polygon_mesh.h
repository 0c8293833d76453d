#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Appends a polygon of a file as triangles. One of fewer than three corners, a point or a line, has none.
/// @param corners  indices of the mesh's vertices.
/// @throws std::runtime_error for an index without a vertex, or more corners than a polygon may have.
void appendPolygon(const std::vector<std::int64_t>& corners, TriangleMesh& mesh);

}  // namespace sdf_ccd
