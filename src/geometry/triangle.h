#pragma once

#include "geometry/flat_cylinder.h"
#include "sdf_ccd/common/eigen_types.h"

/// Queries of a single triangle abc, which may be degenerate (a segment, a point).
namespace sdf_ccd {

/// Closest point of the segment ab to p.
Vector3d closestOnSegment(const Vector3d& a, const Vector3d& b, const Vector3d& p);

/// Closest point of the triangle to p. Always a convex combination of the corners, up to rounding, also for slivers.
///
/// Source: Ericson 2005, Real-Time Collision Detection, §5.1.5; slivers are checked against their edges, because
/// the Voronoi tests of that method cancel there.
Vector3d closestOnTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p);

/// A triangle with precomputed data for many closest-point queries.
class MeasuredTriangle {
 public:
  MeasuredTriangle(const Vector3d& a, const Vector3d& b, const Vector3d& c);

  /// As closestOnTriangle().
  Vector3d closest(const Vector3d& p) const;

  /// False only if all points of the triangle are certainly farther than `distance` from p.
  bool mayBeWithin(double distance, const Vector3d& p) const { return disc_.mayBeWithin(distance, p); }

  /// True if it is so thin that its plane is uncertain.
  bool sliver() const { return sliver_; }

  /// A sphere that contains the triangle.
  const Vector3d& center() const { return disc_.center; }
  double radius() const { return disc_.radius; }

  const Vector3d& a() const { return a_; }
  const Vector3d& b() const { return b_; }
  const Vector3d& c() const { return c_; }

 private:
  Vector3d a_, b_, c_;
  bool sliver_;
  FlatCylinder disc_;  ///< in its plane; for a sliver a sphere
};

/// Signed solid angle of the triangle seen from p, over 4π: positive where p lies behind the counter-clockwise
/// side. Zero at the corners and along the edges, ±½ inside the triangle, never NaN.
///
/// Source: Van Oosterom & Strackee 1983, Eq. (8).
double solidAngleFraction(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& p);

}  // namespace sdf_ccd
