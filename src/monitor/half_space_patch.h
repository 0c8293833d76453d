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

  /// Places the triangle below all points within ball.radius + travel of the ball's center. It depends on the arguments
  /// alone. Memory is allocated only when the triangle's size changes, by a factor of two or more.
  void cover(const BoundingBall& ball, double travel);

  /// The triangle. cover() must have been called.
  const BoxTree& tree() const { return *tree_; }

  /// Upper bound of the triangle's distance from the surface, by rounding [m].
  double deviation() const { return deviation_; }

 private:
  HalfSpace half_space_;
  double offset_error_;
  double size_ = 0.0;  // of a cell of the lattice of centers [m]
  double deviation_ = 0.0;
  std::optional<BoxTree> at_origin_;  // the triangle with its center at the frame's origin
  std::optional<BoxTree> tree_;       // displaced to a center on the lattice
};

}  // namespace sdf_ccd
