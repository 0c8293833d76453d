#pragma once

#include <vector>

#include "mesh/mesh_patches.h"

namespace sdf_ccd {

/// How a closed patch is to be treated, and its properties then.
struct ClosedComponent {
  bool flip = false;
  bool cavity = false;
  int negative_triangles = 0;  ///< with a winding number of the patch behind them that is not above zero, although the
                               ///< patch as a whole is oriented correctly: they bound a lobe of a self-intersecting one
  /// What is inside is not certain: the patch encloses no volume; it is flipped or has a lobe, and there are others or
  /// it may cancel itself; or it is a cavity that does not lie in exactly one other patch, apart from all others.
  bool doubtful = false;
};

/// Determines which closed patches of a mesh must be flipped so that the winding number of all of them together is not
/// zero wherever a solid is.
///
/// The orientation of a patch follows from its own winding number just behind its triangles: from the area of the
/// triangles that are visible from points where the number is zero or, if that is not clear, from its volume. If every
/// patch that lies in no other one is inside out, the whole file is, and all patches are flipped, including cavities.
/// After that, a patch that is inside out is kept so, as a cavity, only if others certainly contain it: their winding
/// number at it is not zero, and it does not cut or touch them. Patches that are not closed are not considered.
/// @param mesh  consistently oriented, about 1 m large and near the origin.
/// @return one per patch; default values for patches that are not closed.
std::vector<ClosedComponent> inspectClosed(const TriangleMesh& mesh, const std::vector<Patch>& patches);

}  // namespace sdf_ccd
