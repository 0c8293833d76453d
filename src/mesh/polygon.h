#pragma once

#include <vector>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Triangles that fill a polygon in space, by ear clipping in the plane of its vector area (Meisters 1975). Concave
/// polygons are filled correctly, self-intersecting ones arbitrarily; there are always size − 2 triangles.
/// @return indices into `corners`, in the polygon's orientation; none for fewer than three corners.
std::vector<Vector3i> triangulatePolygon(const std::vector<Vector3d>& corners);

}  // namespace sdf_ccd
