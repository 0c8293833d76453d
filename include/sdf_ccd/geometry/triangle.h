#pragma once

#include "sdf_ccd/geometry/eigen_types.h"

/// What a single triangle abc answers. Degenerate triangles (a segment, a point) are welcome.
namespace sdf_ccd {

/// Closest point of the segment ab to p.
Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p);

/// Closest point of the triangle to p. Always a convex combination of the corners, to rounding, also for slivers.
///
/// Source: Ericson 2005, Real-Time Collision Detection, §5.1.5; slivers are checked against their edges, because
/// the Voronoi tests of that method cancel there.
Vector3d closestOnTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p);

/// Signed solid angle of the triangle seen from p, over 4π: positive where p lies behind the counter-clockwise
/// side. Zero at the corners and along the edges, ±½ inside the triangle, never NaN.
///
/// Source: Van Oosterom & Strackee 1983, Eq. (8).
double solidAngleFraction(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p);

}  // namespace sdf_ccd
