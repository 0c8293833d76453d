#pragma once

#include "geometry/box_tree.h"

namespace sdf_ccd {

/// Whether some ray from p meets no triangle, and passes none by less than 4e-6 of the surface's size. False wherever
/// triangles enclose p, in whatever orientation; true at most other points. As TriangleTree::seesOutside(), for rounded
/// triangles.
/// @param p  in the tree's frame, outside of every rounded triangle.
bool seesOutside(const BoxTree& tree, const Vector3d& p);

}  // namespace sdf_ccd
