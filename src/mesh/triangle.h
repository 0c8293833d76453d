#pragma once

#include "mesh/corners.h"
#include "mesh/flat_cylinder.h"

/// Queries of a single triangle, which may be degenerate (a segment, a point).
namespace sdf_ccd {

/// Closest point of the segment ab to p.
Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p);

/// Closest point of the triangle to p. Always a convex combination of the corners, up to rounding, also for slivers.
///
/// Source: Ericson 2005, Real-Time Collision Detection, §5.1.5; slivers are checked against their edges, because
/// the Voronoi tests of that method cancel there.
Vector3d closestOnTriangle(const Corners& triangle, const Vector3d& p);

/// A triangle with precomputed data for many closest-point queries.
class MeasuredTriangle {
 public:
  explicit MeasuredTriangle(const Corners& corners);

  /// As closestOnTriangle().
  Vector3d closest(const Vector3d& p) const;

  /// False only if all points of the triangle are certainly farther than `distance` from p.
  bool mayBeWithin(double distance, const Vector3d& p) const { return disc_.mayBeWithin(distance, p); }

  /// True if it is so thin that its plane is uncertain.
  bool sliver() const { return sliver_; }

  /// A sphere that contains the triangle.
  const Vector3d& center() const { return disc_.center; }
  double radius() const { return disc_.radius; }

  const Corners& corners() const { return corners_; }

 private:
  Corners corners_;
  bool sliver_;
  FlatCylinder disc_;  ///< in its plane; for a sliver a sphere
};

/// Sum of the signed solid angles of triangles seen from p, over 4π: each is positive where p lies behind the
/// counter-clockwise side, zero at the corners and along the edges, ±½ inside the triangle. Never NaN.
///
/// Half a solid angle is the argument of a complex number. The sum is that of their product, and of the turns that it
/// has made: one arc tangent for all triangles.
///
/// Source: Van Oosterom & Strackee 1983, Eq. (8).
class SolidAngleSum {
 public:
  explicit SolidAngleSum(const Vector3d& p) : p_(p) {}

  void add(const Corners& triangle);

  double value() const;

 private:
  Vector3d p_;
  double real_ = 1.0, imaginary_ = 0.0;
  double turns_ = 0.0;  // of the product, and its argument when it was last scaled to 1
};

}  // namespace sdf_ccd
