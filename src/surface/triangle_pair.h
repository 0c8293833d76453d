#pragma once

#include <optional>

#include "mesh/corners.h"

/// Queries about two triangles. Degenerate triangles (a segment, a point) are allowed.
namespace sdf_ccd {

/// The closest points of two triangles that do not cross; for triangles that cross, points of their borders.
///
/// Source: Ericson 2005, Real-Time Collision Detection, §5.1.9 to 5.1.10: of triangles that do not cross, either two
/// edges are nearest or a corner and a face. Where edges are nearly parallel, rounding may miss the closest points by
/// about 1e-8 of the triangles' size: use gapAlong() for proofs.
struct ClosestPair {
  Vector3d on_a, on_b;
  double distance2;  ///< [m²]
};
ClosestPair closestPoints(const Corners& a, const Corners& b);

/// The gap of B beyond A along the axis [m]: if positive, a lower bound of the distance of A and B. (Two convex sets
/// that do not meet have a plane between them.) The rounding error is less than 8 ε of the corners' largest distance
/// from the frame's origin.
/// @param axis  of any length; -inf if it has none.
double gapAlong(const Vector3d& axis, const Corners& a, const Corners& b);

/// The point where the edge pq crosses the triangle; std::nullopt unless they cross for every relative displacement of
/// up to `error` [m].
///
/// The proof. Let L be the edge's length, s and t the distances of p and q from the triangle's plane, on different
/// sides and both above the error m. However both are displaced, the edge still crosses the plane. It does so within m
/// of a point of pq that is within m of the plane, hence within m (1 + L / (s + t)) of the point where pq crosses it.
/// The triangle must extend at least this far around that point.
///
/// Rounding tilts the normal of a narrow triangle, with edges u and v at a corner c, by less than
/// e = 8 ε |u| |v| / |u × v|: differences of corners and their cross product have errors of less than 3 ε |u| |v|, and
/// the dot product adds 2 ε. With D the largest distance of the other four points from c, heights are then off by e D,
/// the point where pq crosses the plane by e D L / (s + t), and its distances from the triangle's edges by 2 e D.
/// Adding 2 e D to m accounts for all of them. `error` has to include the rounding of the coordinates themselves, 4 ε
/// of their size.
std::optional<Vector3d> piercedPoint(const Corners& triangle, const Vector3d& p, const Vector3d& q, double error);

/// Where an edge of one triangle crosses the other one, as above.
std::optional<Vector3d> crossingPoint(const Corners& a, const Corners& b, double error);

}  // namespace sdf_ccd
