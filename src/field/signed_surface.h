#pragma once

#include "sdf_ccd/geometry/triangle_tree.h"

namespace sdf_ccd {

/// Exact signed distances to a mesh: closest points, signs from the winding number.
class SignedSurface {
 public:
  explicit SignedSurface(const TriangleMesh& mesh);

  const TriangleTree& tree() const { return tree_; }

  /// True if the sign of the distance can change only across a triangle.
  bool closed() const { return closed_; }

  /// A closed mesh's solid is where the winding number is not zero, so that parts may overlap and turn either way.
  bool inside(const Vector3d& p) const {
    return tree_.inside(p, closed_ ? TriangleTree::Inside::kNotZero : TriangleTree::Inside::kAboveHalf);
  }

  double signedDistance(const Vector3d& p) const { return nearest(p).distance; }

  /// A signed distance, and the triangle it is to.
  struct Nearest {
    double distance;
    int triangle;
  };

  Nearest nearest(const Vector3d& p) const;

  /// The same at a place `step` away from one where it is `last`. Where the two balls without surface meet, the sign is
  /// the same (if the mesh is closed).
  Nearest next(const Vector3d& p, const Nearest& last, double step) const;

 private:
  TriangleTree tree_;
  bool closed_;
};

}  // namespace sdf_ccd
