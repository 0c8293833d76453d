#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/triangle_cut.h"
#include "sdf_ccd/common/bounding_ball.h"

namespace sdf_ccd {

/// All points within `radius` of a triangle. A ball is one whose corners are the same, a capsule one with two corners.
struct RoundedTriangle {
  Corners corners;      ///< [m]
  double radius = 0.0;  ///< [m]
};

/// Hierarchy of oriented boxes over the triangles of a surface, for what two surfaces that move against each other tell
/// of their distance. Eight boxes are tested at a time, in single precision.
///
/// Source: Gottschalk, Lin, Manocha 1996 (boxes along the surface's main directions); wide nodes as in Wald, Benthin,
/// Boulos 2008. TriangleTree answers points; its boxes lie along the axes, which many more boxes of two surfaces that
/// run beside each other overlap for.
class BoxTree {
 public:
  /// Eight boxes side by side: center + Σ x_i axis_i, |x_i| ≤ half_i, and all within `radius` of that.
  struct Node {
    static constexpr int kWidth = 8;
    using Lane = std::array<float, kWidth>;

    std::array<Lane, 3> center;               ///< from the tree's origin [m]
    std::array<std::array<Lane, 3>, 3> axis;  ///< axis[i][k]: coordinate k of the axis i; the first is the flattest
    std::array<Lane, 3> half;                 ///< [m]
    Lane radius;                              ///< [m]; of boxes not in use -1e30
    Lane reach;                               ///< no point of the box is farther from its center [m]
    std::array<std::int32_t, kWidth> below;   ///< the node of the boxes within; of one triangle ~ its index
    std::int32_t count;                       ///< boxes in use
  };

  /// A box, by its node and its place there.
  struct Slot {
    std::int32_t node = 0;
    std::int32_t lane = 0;
  };

  /// @param triangles  one or more, finite.
  explicit BoxTree(std::vector<RoundedTriangle> triangles);

  const RoundedTriangle& triangle(int i) const { return triangles_[i]; }
  std::size_t size() const { return triangles_.size(); }

  /// The first node holds one box, around all.
  Slot root() const { return {}; }
  const Node& node(std::int32_t i) const { return nodes_[i]; }
  static bool isTriangle(std::int32_t below) { return below < 0; }
  static int triangleOf(std::int32_t below) { return ~below; }

  const Vector3d& origin() const { return origin_; }  ///< that boxes count from
  const BoundingBall& ball() const { return ball_; }  ///< about the origin, around all
  std::size_t bytes() const { return nodes_.size() * sizeof(Node) + triangles_.size() * sizeof(RoundedTriangle); }

 private:
  class Builder;

  std::vector<RoundedTriangle> triangles_;
  std::vector<Node> nodes_;
  Vector3d origin_ = Vector3d::Zero();
  BoundingBall ball_;
};

/// A box of one tree as another tree's frame sees it, from that one's origin.
struct PlacedBox {
  std::array<float, 3> center;
  std::array<std::array<float, 3>, 3> axis;  ///< axis[i][k]
  std::array<float, 3> half;
  float radius;
  float reach;
};

/// How the boxes of a node and another box move against each other meanwhile, in the node's frame: a point x [m] from
/// the node's origin is displaced against where it is when they are tested by no more, to either side, than
///   shift + turn x   and, in any direction,   any + any_per_reach × the reach of its box.
struct BoxMotion {
  std::array<float, 3> shift;
  std::array<std::array<float, 3>, 3> turn;  ///< turn[i][k]
  float any;
  float any_per_reach;
};

/// Which of a node's boxes may come as near to another box as `cut`, or nearer, at any time of a motion.
struct NearBoxes {
  BoxTree::Node::Lane gaps;  ///< lower bounds of the distances: the largest gap along the axes of both and along
                             ///< `direction`; negative if they may meet. Roundings are not taken off: see kBoxRounding
  std::uint32_t near;        ///< by bits
  float least_other;         ///< least gap of those that are not [m]
};
void boxGaps(const BoxTree::Node& node, const PlacedBox& box, const std::array<float, 3>& direction,
             const BoxMotion& motion, float cut, NearBoxes& found);

/// How far the node's boxes reach along `direction` (unit), at most, all along a motion.
void boxSupports(const BoxTree::Node& node, const std::array<float, 3>& direction, const BoxMotion& motion,
                 BoxTree::Node::Lane& supports);

/// What boxGaps() and boxSupports() may be off by, over the size of the coordinates that go in: the radii of both trees
/// about their origins, and the distance of these.
///
/// With ε = 2⁻²⁴ and M that size: a center that is placed by a rounded pose is off by 8 ε M, the difference of two by
/// ε M more, and its product with an axis by 3 ε M (Cauchy: Σ |n_k d_k| ≤ |n| |d|). An axis that is placed is off by 5
/// ε, its product with an axis by 3 ε more, times half sizes of √3 M at most: 14 ε M for either box. Rounded axes are
/// not quite square to each other: a box that holds what it shall along each of them reaches farther along a third
/// direction by the part 3 ε of its half sizes, 6 ε M for either. Sums of seven terms add 7 ε M, axes that are not
/// quite unit 2 ε M, and what moves is smaller than M. That is less than 64 ε M.
constexpr double kBoxRounding = 96.0 / (1 << 24);

}  // namespace sdf_ccd
