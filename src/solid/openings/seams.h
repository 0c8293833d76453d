#pragma once

#include <vector>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd {

/// Flat triangles of a mesh, and which of them are seams: these lie on other triangles, between whose sides they fill
/// the gap.
struct Seams {
  std::vector<bool> is_flat;  ///< per triangle: a corner lies on the opposite side, up to the tolerance
  std::vector<bool> is_seam;  ///< per triangle; these are flat
  double farthest = 0.0;      ///< distance of seams from the other triangles, at most [m]
};

/// A flat triangle is within the tolerance [m] of its longest side, and of the other two together. So it is near the
/// surface if that side is, or both others are: along edges of other triangles, or sides of seams known already. A
/// needle that sticks out shares no more than one short side with the surface.
Seams findSeams(const TriangleMesh& mesh, double tolerance);

}  // namespace sdf_ccd
