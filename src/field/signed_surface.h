#pragma once

#include <utility>

#include "geometry/solid_boundary.h"

namespace sdf_ccd {

/// Exact signed distances to the boundary of a mesh's solid: closest points there, signs from the winding number of all
/// triangles.
class SignedSurface {
 public:
  explicit SignedSurface(const TriangleMesh& mesh) : SignedSurface(Solid(mesh)) {}
  explicit SignedSurface(Solid solid) : solid_(std::move(solid)) {}

  const Solid& solid() const { return solid_; }
  const TriangleTree& tree() const { return solid_.tree(); }  ///< over the boundary's triangles

  /// True if the sign of the distance can change only across a triangle.
  bool closed() const { return solid_.closed(); }

  bool inside(const Vector3d& p) const { return solid_.inside(p); }

  double signedDistance(const Vector3d& p) const { return nearest(p).distance; }

  /// A signed distance, and the boundary's triangle it is to.
  struct Nearest {
    double distance;
    int triangle;
  };

  Nearest nearest(const Vector3d& p) const;

  /// The same at a point `step` away from one where it is `last`. If the two empty spheres intersect, the sign is
  /// the same (if the mesh is closed).
  Nearest next(const Vector3d& p, const Nearest& last, double step) const;

 private:
  Solid solid_;
};

}  // namespace sdf_ccd
