#pragma once

#include <string>

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// Reads the vertices and polygons (`v`, `f`) of a Wavefront OBJ; all else is skipped, material libraries too.
/// @throws std::runtime_error with the reason if a vertex or a polygon is incomplete or invalid.
TriangleMesh parseObj(const std::string& bytes);

}  // namespace sdf_ccd
