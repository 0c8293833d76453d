#pragma once

#include <functional>
#include <optional>

#include "box_tree.h"

namespace sdf_ccd {

/// Winding number of a closed surface at p, by the triangles that a ray crosses: exact, as rays that pass an edge by
/// less than 4e-6 of the tree's size are not used.
/// @param p        in the tree's frame, not on a triangle.
/// @param belongs  the triangles of the surface, by their index in the tree: closed (up to such cracks) and
/// consistently
///                 oriented. Spheres and capsules never count.
/// @return nothing if no ray can be used.
std::optional<int> windingNumber(const BoxTree& tree, const Vector3d& p, const std::function<bool(int)>& belongs);

}  // namespace sdf_ccd
