#pragma once

#include <vector>

#include "mesh/mesh_patches.h"

namespace sdf_ccd {

/// Determines which patches that are not closed must be flipped so that their front sees the outside.
///
/// Rays are cast from points spread over a patch, from both its sides (Takayama et al. 2014): the side from which more
/// of them leave the mesh sees the outside. A ray that meets another patch shows that both sides bound the same space,
/// outside or inside (Borodin et al. 2004); it is counted according to what is known of the other side: that of a
/// closed patch, or of an open one in its current orientation. A patch with no clear majority keeps its orientation.
///
/// None is flipped if all of them bound a solid as they are drawn, such as overlapping solids whose triangles do not
/// share the vertices of their edges: rays do not show what is outside of these.
///
/// The rays are the same each time, and their number is bounded: the cost is that of a tree over the mesh and at
/// most two million rays.
/// @param mesh  closed patches correctly oriented; about 1 m large and near the origin. Triangles that belong to no
/// patch occlude others.
std::vector<char> openPatchesToFlip(const TriangleMesh& mesh, const std::vector<Patch>& patches);

}  // namespace sdf_ccd
