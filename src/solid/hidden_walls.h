#pragma once

#include <vector>

#include "mesh/mesh_patches.h"

namespace sdf_ccd {

/// Which of `walls` lie inside the solid that the closed patches of a mesh bound: the patches' winding number at the
/// wall is not zero, and none of their triangles cuts the wall, so that the number is the same all over the wall and on
/// both of its sides. If there are open patches too, the winding number of all patches must agree.
/// @param mesh   correctly oriented; about 1 m large and near the origin.
/// @param walls  triangles with corners in `mesh`.
std::vector<char> hiddenWalls(const TriangleMesh& mesh, const std::vector<Patch>& patches,
                              const std::vector<Vector3i>& walls);

}  // namespace sdf_ccd
