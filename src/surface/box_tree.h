#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/corners.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// All points within `radius` of a triangle. A sphere has three equal corners, a capsule two different ones.
struct RoundedTriangle {
  Corners corners;      ///< [m]
  double radius = 0.0;  ///< [m]
};

/// Hierarchy of oriented bounding boxes over the triangles of a surface, for bounds on the distance of two surfaces
/// that move against each other. Eight boxes are tested at a time, in single precision.
///
/// Source: Gottschalk, Lin, Manocha 1996 (boxes along the surface's principal axes); wide nodes as in Wald, Benthin,
/// Boulos 2008. TriangleTree answers point queries; its boxes are axis-aligned, and many more of them overlap if two
/// surfaces run beside each other.
class BoxTree {
 public:
  /// Eight boxes side by side: the points center + Σ x_i axis_i with |x_i| ≤ half_i, and all within `radius` of
  /// these.
  struct Node {
    static constexpr int kWidth = 8;
    using Lane = std::array<float, kWidth>;

    std::array<Lane, 3> center;               ///< from the tree's origin [m]
    std::array<std::array<Lane, 3>, 3> axis;  ///< axis[i][k]: coordinate k of axis i; the box is thinnest along 0
    std::array<Lane, 3> half;                 ///< [m]
    Lane radius;                              ///< [m]; -1e30 for unused boxes
    Lane reach;                               ///< upper bound of the distance of the box's points from its center [m]
    std::array<std::int32_t, kWidth> below;   ///< index of the child node; for a single triangle, ~ its index
    std::int32_t count;                       ///< used boxes
  };

  /// A box, by its node and its position in the node.
  struct Slot {
    std::int32_t node = 0;
    std::int32_t lane = 0;

    bool operator==(const Slot& o) const { return node == o.node && lane == o.lane; }
  };

  /// @param triangles  one or more, finite.
  /// @param order      if given, set to the index in `triangles` of each of the tree's triangles.
  explicit BoxTree(const std::vector<RoundedTriangle>& triangles, std::vector<int>* order = nullptr);

  /// Turns a copy of another tree into that tree with all of its triangles displaced. Allocates nothing.
  void displace(const BoxTree& original, const Vector3d& displacement);

  RoundedTriangle triangle(int i) const { return {copyOf(corners(i)), radius(i)}; }
  CornerPointers corners(int i) const {
    const Indices& t = triangles_[i];
    return {&corners_[t[0]], &corners_[t[1]], &corners_[t[2]]};
  }
  double radius(int i) const { return radii_.empty() ? 0.0 : radii_[i]; }
  std::size_t size() const { return triangles_.size(); }

  /// The first node holds a single box, around all triangles.
  Slot root() const { return {}; }
  const Node& node(std::int32_t i) const { return nodes_[i]; }
  static bool isTriangle(std::int32_t below) { return below < 0; }
  static int triangleOf(std::int32_t below) { return ~below; }

  const Vector3d& origin() const { return origin_; }  ///< of the boxes' coordinates
  const BoundingBall& ball() const { return ball_; }  ///< about the origin, around all triangles
  std::size_t bytes() const {
    return nodes_.size() * sizeof(Node) + triangles_.size() * sizeof(Indices) + corners_.size() * sizeof(Vector3d) +
           radii_.size() * sizeof(double);
  }

 private:
  class Builder;
  using Indices = std::array<std::int32_t, 3>;

  std::vector<Vector3d> corners_;   ///< each position once, in the order of the triangles [m]
  std::vector<Indices> triangles_;  ///< in `corners_`
  std::vector<double> radii_;       ///< of the triangles; none if all are zero [m]
  std::vector<Node> nodes_;
  Vector3d origin_ = Vector3d::Zero();
  BoundingBall ball_;
};

/// A box of one tree in another tree's frame, relative to that tree's origin.
struct PlacedBox {
  std::array<float, 3> center;
  std::array<std::array<float, 3>, 3> axis;  ///< axis[i][k]
  std::array<float, 3> half;
  float radius;
  float reach;
};

/// Bounds the motion of a node's boxes and another box against each other, in the node's frame: compared with the time
/// of the test, a point x [m] from the origin of the node's tree is displaced, to either side, by no more than
///   shift + turn x   and, in any direction,   any + any_per_reach × the reach of its box.
struct BoxMotion {
  std::array<float, 3> shift;
  std::array<std::array<float, 3>, 3> turn;  ///< turn[i][k]
  float any;
  float any_per_reach;
};

/// Which of a node's boxes may come within `cut` of another box at any time of a motion.
struct NearBoxes {
  BoxTree::Node::Lane gaps;  ///< lower bounds of the distances: along the axes of either box together, or along
                             ///< `direction`; negative if they may meet. Rounding is not subtracted: see kBoxRounding
  std::uint32_t near;        ///< bit i: box i
  float least_other;         ///< least gap of the other boxes [m]
};
void boxGaps(const BoxTree::Node& node, const PlacedBox& box, const std::array<float, 3>& direction,
             const BoxMotion& motion, float cut, NearBoxes& found);

/// The same with displacements bounded along each of these directions by themselves instead of any_per_reach: gaps of
/// boxes that turn on each other are larger. Takes longer.
void directedBoxGaps(const BoxTree::Node& node, const PlacedBox& box, const std::array<float, 3>& direction,
                     const BoxMotion& motion, float cut, NearBoxes& found);

/// The same where the other box moves: `motion` is that of its center, and its other points are displaced by up to
/// ± spread_0 ± spread_1 ± spread_2 more.
void directedBoxGaps(const BoxTree::Node& node, const PlacedBox& box, const std::array<float, 3>& direction,
                     const BoxMotion& motion, const std::array<std::array<float, 3>, 3>& spread, float cut,
                     NearBoxes& found);

/// Bounds the motion of boxes along one direction: a point x [m] from the origin of their tree is displaced along it,
/// to either side, by no more than |shift + turn x| + any.
struct MotionAlong {
  float shift;
  std::array<float, 3> turn;
  float any;
};

/// Upper bounds of the extents of the node's boxes along `direction` (unit) during a motion, from the tree's origin
/// [m].
void boxSupports(const BoxTree::Node& node, const std::array<float, 3>& direction, const MotionAlong& motion,
                 BoxTree::Node::Lane& supports);

/// Upper bound of the rounding errors of boxGaps() and boxSupports(), relative to the size of the coordinates: the
/// radii of both trees about their origins plus the distance of the origins.
///
/// With ε = 2⁻²⁴ and M that size: a center transformed by a rounded pose has an error of 8 ε M, the difference
/// of two ε M more, and its product with an axis 3 ε M (Cauchy: Σ |n_k d_k| ≤ |n| |d|). A transformed axis has an
/// error of 5 ε, its product with an axis 3 ε more, times half sizes of at most √3 M: 14 ε M for each box. Rounded
/// axes are not exactly orthogonal: a box that contains its triangles along each of them reaches farther along a third
/// direction by 3 ε of its half sizes, 6 ε M for each. Sums of seven terms add 7 ε M, axes that are not exactly unit
/// 2 ε M. A displacement has a relative error of 4 ε, and so have the three by which a box's ends move more, together
/// no more than √3 M: 11 ε M; when a gap is small, the boxes are displaced by no more than about M at that time, even
/// if they pass each other quickly. In total that is less than 77 ε M along an axis. The root of the squares of three
/// gaps adds up to √3 of that, 134 ε M; three axes off by 5 ε each are orthogonal up to 9 ε, and squares, sums and
/// roots are rounded, 3 ε. In total that is less than 147 ε M.
constexpr double kBoxRounding = 160.0 / (1 << 24);

}  // namespace sdf_ccd
