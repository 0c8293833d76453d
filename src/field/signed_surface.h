#pragma once

#include <utility>

#include "solid/solid_boundary.h"

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

  /// A signed distance [m], and the nearest of the boundary's triangles.
  struct Nearest {
    double distance;
    int triangle;
  };

  Nearest nearest(const Vector3d& p) const;

  /// As nearest(), but cheaper, at a point `step` [m] away from one where the result was `last`. If the mesh is closed
  /// and the empty spheres about both points intersect, the sign is the same.
  Nearest next(const Vector3d& p, const Nearest& last, double step) const;

 private:
  Solid solid_;
};

}  // namespace sdf_ccd
