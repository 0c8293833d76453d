#pragma once

#include <cstdint>
#include <vector>

#include "sdf_ccd/geometry/interior.h"

namespace sdf_ccd {

/// For each triangle 1 if it is certain that its front faces the outside and its back the inside: the interior
/// says so before and behind it, its edges are shared by neighbours that agree with it, no other triangle cuts or
/// overlaps it, and it has an area. Where only such triangles are near, the gradient of the signed distance lies in
/// the convex cone of their normals.
///
/// Cut and overlap are decided with a tolerance of 1e-10 of the mesh's size, on the cautious side.
/// @param tree, interior  of the same mesh.
std::vector<std::uint8_t> separatingTriangles(const TriangleMesh& mesh, const TriangleTree& tree,
                                              const Interior& interior);

}  // namespace sdf_ccd
