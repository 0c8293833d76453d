#pragma once

#include <optional>
#include <vector>

#include "field/signed_surface.h"
#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd::precision {

/// Answers of the mesh itself, in double precision: the reference for fields.
class ExactSurface {
 public:
  /// @param mesh  oriented (see orientOutward()).
  explicit ExactSurface(const TriangleMesh& mesh);

  /// The solid's boundary; the nearest triangle is one of its triangles.
  const TriangleMesh& mesh() const { return surface_.solid().boundary(); }
  const SignedSurface& surface() const { return surface_; }

  /// Signed distance [m]: closest triangle, sign from the winding number.
  double distance(const Vector3d& p) const { return surface_.signedDistance(p); }

  /// The same without a sign.
  double unsignedDistance(const Vector3d& p) const { return surface_.tree().closestPoint(p).distance; }

  /// Parameter in [0, 1] of the segment's first crossing of a triangle. Far from the surface it steps through empty
  /// spheres, else it tests every triangle close to the next piece. Coplanar triangles are left to their neighbours;
  /// edges are widened by rounding, so that no segment passes between two triangles.
  std::optional<double> firstHit(const Segment& segment) const;

 private:
  SignedSurface surface_;
  double near_;  ///< half of the longest piece whose triangles are all tested [m]
};

}  // namespace sdf_ccd::precision
