#pragma once

#include <optional>

#include "geometry/box_tree.h"
#include "sdf_ccd/body/body.h"

namespace sdf_ccd {

/// Whether the body is a single half-space.
bool isHalfSpace(const Body& body);

/// The part of a half-space's surface near a bounded body, as a triangle in the frame of the half-space's body. Whether
/// the other body stays apart from the whole surface, how far, or crosses it, is known from the triangle alone: it
/// contains the foot of every point of that body.
class HalfSpacePatch {
 public:
  /// Of a body that isHalfSpace().
  explicit HalfSpacePatch(const Body& body);

  const Vector3d& normal() const { return half_space_.normal; }

  /// Signed distance [m].
  double distance(const Vector3d& p) const { return half_space_.normal.dot(p) - half_space_.offset; }

  /// Makes the triangle, unless it is the last call's, for all points within ball.radius + travel of the ball's center.
  /// It depends on the arguments alone.
  void cover(const BoundingBall& ball, double travel);

  /// The triangle. cover() must have been called.
  const BoxTree& tree() const { return *tree_; }

  /// Upper bound of the triangle's distance from the surface, by rounding [m].
  double deviation() const { return deviation_; }

 private:
  HalfSpace half_space_;
  double offset_error_;
  Vector3d center_ = Vector3d::Zero();  // of tree_'s triangle [m]
  double size_ = 0.0;                   // of a cell of the lattice of centers [m]
  double deviation_ = 0.0;
  std::optional<BoxTree> tree_;
};

}  // namespace sdf_ccd
