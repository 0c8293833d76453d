#pragma once

#include <optional>

#include "geometry/triangle_cut.h"

/// What two triangles tell of each other. Degenerate ones (a segment, a point) are welcome.
namespace sdf_ccd {

/// Points of two triangles that are nearest to each other, where the triangles do not cross; where they cross, points
/// of their borders.
///
/// Source: Ericson 2005, Real-Time Collision Detection, §5.1.9 to 5.1.10: of triangles that do not cross, either two
/// edges are nearest or a corner and a face. Rounding may miss the nearest by some 1e-8 of the triangles' size where
/// edges are nearly parallel: what is to be proved is proved by gapAlong().
struct ClosestPair {
  Vector3d on_a, on_b;
  double distance2;  ///< [m²]
};
ClosestPair closestPoints(const Corners& a, const Corners& b);

/// Of B along the axis beyond A [m]: no point of A is nearer than that to any of B, if it is positive. (Two convex sets
/// that do not meet have a plane between them.) Off by less than 8 ε of the corners' largest distance from the frame's
/// origin, by rounding.
/// @param axis  of any length; -inf if it has none.
double gapAlong(const Vector3d& axis, const Corners& a, const Corners& b);

/// Where the edge pq passes through the triangle, and does so wherever they are displaced against each other by up to
/// `error` [m].
///
/// The proof. Let L be the edge's length, s and t the distances of p and q from the triangle's plane, on different
/// sides and both above the error m. However both are displaced, the edge still passes the plane, at a place no farther
/// than m from one of pq that is within m of the plane; so within m (1 + L / (s + t)) of where pq passes it. The
/// triangle must reach so far around that place.
std::optional<Vector3d> piercedPoint(const Corners& triangle, const Vector3d& p, const Vector3d& q, double error);

/// Where an edge of one pierces the other, as above.
std::optional<Vector3d> crossingPoint(const Corners& a, const Corners& b, double error);

}  // namespace sdf_ccd
