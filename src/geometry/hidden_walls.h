#pragma once

#include <vector>

#include "mesh_patches.h"

namespace sdf_ccd {

/// Which of `walls` lie inside the solid that the closed patches of a mesh bound: their winding number at the wall is
/// not zero, and none of their triangles cuts the wall, so that it is the same all over it and on both its sides.
/// Beside patches that are not closed, the winding number of all must say the same.
/// @param mesh   turned rightly; about 1 m large and near the origin.
/// @param walls  triangles with corners in `mesh`.
std::vector<char> hiddenWalls(const TriangleMesh& mesh, const std::vector<Patch>& patches,
                              const std::vector<Vector3i>& walls);

}  // namespace sdf_ccd
