#pragma once

#include <cstdint>
#include <vector>

#include "geometry/triangle_tree.h"

namespace sdf_ccd {

/// Lengths below which surfaces of a mesh are not distinguished [m].
struct SurfaceTolerance {
  double layer;     ///< triangles this near to each other are layers of one surface
  double border;    ///< width of a strip along the border of a piece that may be ignored
  double rounding;  ///< upper bound of the rounding error of a height above a triangle's plane
  double closest;   ///< upper bound of closestError()
};

SurfaceTolerance surfaceTolerance(const TriangleMesh& mesh);

/// Upper bound of the error of the closest point that closestOnTriangle() finds [m]: negligible for most triangles, but
/// up to 4e-8 of the length of a thin one.
double closestError(const Vector3d& a, const Vector3d& b, const Vector3d& c);

/// Whether a triangle's plane is certain: its height exceeds a share of its longest edge, and a length.
bool hasCertainPlane(const TriangleMesh& mesh, int triangle, const SurfaceTolerance& tolerance);

/// Per triangle, those that cut it, overlap it or touch it elsewhere than at shared vertices and edges, within the
/// tolerance of a layer; conservative. Only triangles with a certain plane have lists.
struct TriangleCuts {
  std::vector<std::vector<int>> of;  ///< ascending
  std::size_t pairs = 0;             ///< entries of all lists
  bool complete = true;              ///< false: there are more than `max_pairs`; lists hold only their first entries
};

/// @param tree  over the same mesh.
TriangleCuts triangleCuts(const TriangleMesh& mesh, const TriangleTree& tree, const SurfaceTolerance& tolerance,
                          std::size_t max_pairs);

}  // namespace sdf_ccd
