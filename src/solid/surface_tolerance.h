#pragma once

#include "mesh/corners.h"

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
double closestError(const Corners& c);

/// Whether a triangle's plane is certain: its height exceeds a share of its longest edge, and a length.
bool hasCertainPlane(const TriangleMesh& mesh, int triangle, const SurfaceTolerance& tolerance);

}  // namespace sdf_ccd
