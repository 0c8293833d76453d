#pragma once

#include <vector>

#include "mesh_patches.h"

namespace sdf_ccd {

/// What is to be done with a closed patch, and what is known of it then.
struct ClosedComponent {
  bool turn = false;
  bool cavity = false;
  bool flat = false;           ///< a sheet drawn from both sides
  int negative_triangles = 0;  ///< behind them the patch's own winding number is not above zero, though it is turned
                               ///< rightly as a whole: they bound a lobe of a patch that crosses itself
  /// Winding numbers may cancel where a solid is: such a lobe's patch meets another one or itself in edges, two
  /// cavities cut each other, the volume is zero though the patch is not flat, flat ones may enclose something. Or a
  /// cavity may be filled, or a solid taken for one: it lies in another, and one of the two is inside out, or mixed
  /// (see Patch), or it lies in several.
  bool doubtful = false;
};

/// Which closed patches of a mesh must be turned so that the winding number, of all of them together, is not zero
/// wherever a solid is.
///
/// A patch's own winding number just behind its triangles says which way it faces, by the area of those that are seen
/// from places where it is zero; where that is not clear, its volume does. Where every patch that lies in no other one
/// is inside out the file is, and all are turned, cavities too. After that, a patch that faces its inside stays, as a
/// cavity, only if others certainly hold it: their winding number at it is not zero, and it does not cut or touch them.
/// Patches that are not closed have no say.
/// @param mesh  consistently oriented, about 1 m large and near the origin.
/// @return one per patch; as it is by default for patches that are not closed.
std::vector<ClosedComponent> inspectClosed(const TriangleMesh& mesh, const std::vector<Patch>& patches);

}  // namespace sdf_ccd
