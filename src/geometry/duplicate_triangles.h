#pragma once

#include "sdf_ccd/geometry/triangle_mesh.h"

namespace sdf_ccd {

/// A welded mesh without triangles that are there twice.
///
/// Of equal triangles one is kept. So is one of two that face each other (a face drawn from both sides), unless
/// they are a wall between two solids that share it: a patch of such pairs whose every border edge also carries
/// other triangles. That wall is inside the union and both its sides go.
TriangleMesh withoutDuplicates(const TriangleMesh& mesh);

}  // namespace sdf_ccd
