#pragma once

#include <cstdint>
#include <vector>

#include "geometry/triangle_tree.h"

namespace sdf_ccd {

/// Lengths below which surfaces of a mesh are not told apart [m].
struct SurfaceTolerance {
  double layer;     ///< triangles this near to each other are layers of one surface
  double border;    ///< how wide a strip along the border of a piece may be left out of account
  double rounding;  ///< of a height above a triangle's plane, at most
  double closest;   ///< no closestError() is larger
};

SurfaceTolerance surfaceTolerance(const TriangleMesh& mesh);

/// How far from its closest point the one that closestOnTriangle() finds may be [m]: next to nothing for most
/// triangles, but up to 4e-8 of its length on a thin one.
double closestError(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Least height over longest edge, and height, of triangles whose plane is certain.
bool hasCertainPlane(const TriangleMesh& mesh, int triangle, const SurfaceTolerance& tolerance);

/// For each triangle those that cut it, overlap it or touch it elsewhere than at vertices and edges they share, to
/// within the tolerance of a layer, on the cautious side. Only triangles with a certain plane have lists.
struct TriangleCuts {
  std::vector<std::vector<int>> of;  ///< ascending
  std::size_t pairs = 0;             ///< entries of all lists
  bool complete = true;              ///< false: there are more than `max_pairs`; lists hold their first entries alone
};

/// @param tree  over the same mesh.
TriangleCuts triangleCuts(const TriangleMesh& mesh, const TriangleTree& tree, const SurfaceTolerance& tolerance,
                          std::size_t max_pairs);

}  // namespace sdf_ccd
