#pragma once

#include <vector>

#include "mesh_patches.h"

namespace sdf_ccd {

/// Which patches that are not closed must be turned for their front to see the outside.
///
/// Rays from points spread over a patch, from both its sides, tell what can see it (Takayama et al. 2014): the side
/// from which more of them leave the mesh sees the outside. Those that meet another patch tell that both sides are in
/// the same space, outside or inside (Borodin et al. 2004), and are counted with what is known of the other side: that
/// of a closed patch, or of an open one as it is turned so far. A patch with no clear majority stays as it is.
///
/// None is turned if all of them bound a solid as they are drawn, as those of solids that overlap, whose triangles do
/// not share their edges' vertices: rays do not tell what is outside of these.
///
/// The same rays each time; their number is bounded, so that the cost is that of a tree over the mesh and at most two
/// million rays.
/// @param mesh  closed patches turned rightly; about 1 m large and near the origin. Triangles of no patch hide others.
std::vector<char> seenFromBehind(const TriangleMesh& mesh, const std::vector<Patch>& patches);

}  // namespace sdf_ccd
