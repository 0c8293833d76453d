#pragma once

#include <cmath>
#include <limits>

#include "surface/box_tree.h"
#include "surface/triangle_pairs.h"

namespace sdf_ccd {

/// Sum of the sizes of the coordinates of two trees' triangles, in both frames, at both poses [m].
double coordinateSize(const BoxTree& a, const BoxTree& b, const EndPoses& poses);

/// Upper bound of the rounding errors of distances between triangles, at either pose, along a direction, relative to
/// coordinateSize(): see separation().
constexpr double kTriangleRounding = 32.0 * std::numeric_limits<double>::epsilon();

/// The same bound [m].
inline double triangleRounding(const BoxTree& a, const BoxTree& b, const EndPoses& poses) {
  return kTriangleRounding * coordinateSize(a, b, poses);
}

/// The cut for boxes' gaps: a gap that exceeds it in single precision exceeds the given one in double precision [m].
inline float cutOfBoxes(double cut) {
  return std::nextafter(static_cast<float>(cut), std::numeric_limits<float>::infinity());
}

/// Tests boxes of two trees while B moves relative to A, from one pose to another along chords: at the pose halfway,
/// each box in the other tree's frame. See separation() for the proof.
class MovingBoxes {
 public:
  /// @param error  upper bound of the points' deviation from their chords and of all other errors [m].
  MovingBoxes(const BoxTree& a, const BoxTree& b, const EndPoses& poses, double error);

  /// As boxGaps(), for the boxes of a node of A and one box of B, and with A and B exchanged.
  void gapsInA(const BoxTree::Node& node, BoxTree::Slot box_b, float cut, NearBoxes& found);
  void gapsInB(const BoxTree::Node& node, BoxTree::Slot box_a, float cut, NearBoxes& found);

  /// Sets a unit axis that boxGaps() tests on all boxes.
  void setDirection(const Vector3d& n_A);

  /// From now on, displacements are bounded along each direction by itself, and where one box holds a single triangle
  /// that is larger than the node's boxes, the gaps are those between these boxes and the triangle. That takes longer,
  /// but finds more boxes apart: of surfaces that turn on each other, and of a dense surface.
  void measureClosely() { is_close_ = true; }

  /// Upper bounds of A's extent along the direction, and of B's against it, from A's origin [m]; infinite above
  /// the limit, or if they take too many steps to find.
  double supportA(double limit) const;
  double supportB(double limit) const;

 private:
  const PlacedBox& boxInA(BoxTree::Slot box_b);
  const PlacedBox& boxInB(BoxTree::Slot box_a);
  std::array<std::array<float, 3>, 3> spreadInA(BoxTree::Slot box_b) const;
  Corners placedInA(const Corners& corners_B) const;
  Corners placedInB(const Corners& corners_A) const;

  const BoxTree &a_, &b_;
  std::array<std::array<float, 3>, 3> R_AB_;       ///< rotation halfway, by rows
  std::array<float, 3> b_from_a_, a_from_b_;       ///< B's origin from A's, A's axes; A's from B's, B's axes
  BoxTree::Slot last_b_{-1, -1}, last_a_{-1, -1};  ///< the boxes that were placed last: in A's frame, in B's
  PlacedBox last_in_A_, last_in_B_;
  BoxMotion moving_;                                  ///< of B's boxes, in B's frame
  std::array<std::array<float, 3>, 3> difference_A_;  ///< as moving_'s, but displacements in A's axes, by rows
  std::array<float, 3> shift_A_;
  EndPoses poses_;
  Matrix3d R_middle_;  ///< rotation halfway, from B to A
  Vector3d p_middle_;  ///< B's origin from A's halfway, A's axes
  double error_, rounding_;
  Vector3d n_A_ = Vector3d::UnitZ();  ///< the direction
  std::array<float, 3> direction_A_{0, 0, 1}, direction_B_{0, 0, 1};
  bool is_close_ = false;
};

}  // namespace sdf_ccd
