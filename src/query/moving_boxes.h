#pragma once

#include "geometry/box_tree.h"
#include "lanes/triangle_pairs.h"

namespace sdf_ccd {

/// Boxes of two trees while B moves against A, from one pose to another along chords: as seen halfway, each from the
/// other's frame. See separation() for what that proves.
class MovingBoxes {
 public:
  /// @param error  no point is farther than this from its chord, and all other errors [m].
  MovingBoxes(const BoxTree& a, const BoxTree& b, const EndPoses& poses, double error);

  /// As boxGaps(): of the boxes in a node of A from a box of B, and the other way round.
  void gapsInA(const BoxTree::Node& node, BoxTree::Slot box_b, float cut, NearBoxes& found) const;
  void gapsInB(const BoxTree::Node& node, BoxTree::Slot box_a, float cut, NearBoxes& found) const;

  /// An axis that boxGaps() tries on all boxes, unit.
  void setDirection(const Vector3d& n_A);

  /// How far A reaches along the direction, and B against it, from A's origin, at most [m]; infinite if that is more
  /// than the limit, or takes long to find out.
  double supportA(double limit) const;
  double supportB(double limit) const;

 private:
  PlacedBox boxInA(BoxTree::Slot box_b) const;
  PlacedBox boxInB(BoxTree::Slot box_a) const;

  const BoxTree &a_, &b_;
  std::array<std::array<float, 3>, 3> R_AB_;    ///< halfway, by rows
  std::array<float, 3> b_from_a_, a_from_b_;    ///< B's origin from A's, A's axes; A's from B's, B's axes
  BoxMotion still_, moving_;                    ///< of boxes of A; of B, in B's frame
  std::array<std::array<float, 3>, 3> turn_A_;  ///< of moving_, but displacements in A's axes, by rows
  std::array<float, 3> shift_A_;
  EndPoses poses_;
  double error_;
  Vector3d n_A_ = Vector3d::UnitZ();  ///< the direction
  std::array<float, 3> direction_A_{0, 0, 1}, direction_B_{0, 0, 1};
};

}  // namespace sdf_ccd
