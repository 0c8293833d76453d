#pragma once

#include <optional>
#include <vector>

#include "field/signed_surface.h"
#include "sdf_ccd/segments.h"

namespace sdf_ccd::precision {

/// Exact queries on the mesh in double precision, the reference for fields.
class ExactSurface {
 public:
  /// @param mesh  oriented (see orientOutward()).
  explicit ExactSurface(const TriangleMesh& mesh);

  /// The solid's boundary, on which all queries work.
  const TriangleMesh& mesh() const { return surface_.solid().boundary(); }
  const SignedSurface& surface() const { return surface_; }

  /// Signed distance [m]: closest triangle, sign from the winding number.
  double distance(const Vector3d& p) const { return surface_.signedDistance(p); }

  /// Unsigned distance [m].
  double unsignedDistance(const Vector3d& p) const { return surface_.tree().closestPoint(p).distance; }

  /// Parameter in [0, 1] of the segment's first crossing of a triangle; none if there is none. Steps through empty
  /// spheres far from the surface, and tests all triangles near the next piece of the segment close to it. Triangles
  /// coplanar with the segment are skipped, as it crosses their neighbours; triangles are enlarged by the rounding
  /// error, so that no segment passes between two of them.
  std::optional<double> firstHit(const Segment& segment) const;

 private:
  SignedSurface surface_;
  double near_;  ///< half the length of a piece whose triangles are tested [m]
};

}  // namespace sdf_ccd::precision
