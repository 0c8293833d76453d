#include "box_tree.h"
#include "common/lane_vector.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

using Lane = BoxTree::Node::Lane;
constexpr float kFar = 1e30F;
static_assert(BoxTree::Node::kWidth == kFloatWidth, "a vector holds a node's boxes");

SDF_CCD_INLINE Floats load(const Lane& lane) {
  return lanes::load(lane.data());
}

SDF_CCD_INLINE Floats squareIfPositive(const Floats& v) {
  const Floats positive = larger(v, Floats{});
  return positive * positive;
}

using Vectors = LaneVector<Floats>;  // of eight boxes

SDF_CCD_INLINE Vectors load(const std::array<Lane, 3>& v) {
  return {load(v[0]), load(v[1]), load(v[2])};
}

SDF_CCD_INLINE Vectors displacements(const BoxMotion& m, const Vectors& center) {
  return {center.dot(m.turn[0]) + m.shift[0], center.dot(m.turn[1]) + m.shift[1], center.dot(m.turn[2]) + m.shift[2]};
}

/// Displacements within a box, beyond that of its center: no more than this in any direction.
struct InAnyDirection {
  Floats most;

  template <class Direction>
  SDF_CCD_INLINE Floats along(const Direction&) const {
    return Floats{};
  }
};

/// The same along each direction: of the node's boxes, by their three half extents.
struct OfNode {
  Vectors spread[3];
  Floats most = {};

  template <class Direction>
  SDF_CCD_INLINE Floats along(const Direction& n) const {
    return absolute(spread[0].dot(n)) + absolute(spread[1].dot(n)) + absolute(spread[2].dot(n));
  }
};

/// The same, of the other box.
struct OfOtherBox {
  const std::array<std::array<float, 3>, 3>& spread;
  Floats most = {};

  SDF_CCD_INLINE Floats along(const Vectors& n) const {
    return absolute(n.dot(spread[0])) + absolute(n.dot(spread[1])) + absolute(n.dot(spread[2]));
  }
  SDF_CCD_INLINE Floats along(const std::array<float, 3>& n) const {
    float sum = 0.0F;
    for (const std::array<float, 3>& d : spread) {
      const float one = d[0] * n[0] + d[1] * n[1] + d[2] * n[2];
      sum += one < 0.0F ? -one : one;
    }
    return Floats{} + sum;
  }
};

template <class Spread>
SDF_CCD_INLINE void gaps(const BoxTree::Node& node, const PlacedBox& box, const std::array<float, 3>& direction,
                         const BoxMotion& motion, const Spread& spread, float cut, NearBoxes& found) {
  const Vectors center = load(node.center);
  const Vectors moved = displacements(motion, center);
  const Vectors way = {center.x - box.center[0], center.y - box.center[1], center.z - box.center[2]};
  const Vectors axes[3] = {load(node.axis[0]), load(node.axis[1]), load(node.axis[2])};
  const Floats half[3] = {load(node.half[0]), load(node.half[1]), load(node.half[2])};

  // Along three orthogonal axes, gaps are those of two boxes with faces across these axes, and the distance of such
  // boxes is their root sum of squares.
  Floats along_box[3];  // half extents of the node's boxes along the other box's axes
  Floats best, squares = {}, squares_of_box = {};
  for (int i = 0; i < 3; ++i) {
    Floats reach = half[i] + spread.along(axes[i]);
    for (int j = 0; j < 3; ++j) {
      const Floats cosine = absolute(axes[i].dot(box.axis[j]));
      reach += cosine * box.half[j];
      along_box[j] = i == 0 ? cosine * half[i] : along_box[j] + cosine * half[i];
    }
    const Floats gap = absolute(axes[i].dot(way)) - absolute(axes[i].dot(moved)) - reach;
    best = i == 0 ? gap : larger(best, gap);
    squares += squareIfPositive(gap);
  }
  for (int j = 0; j < 3; ++j) {
    const Floats gap = absolute(way.dot(box.axis[j])) - absolute(moved.dot(box.axis[j])) - along_box[j] -
                       spread.along(box.axis[j]) - box.half[j];
    best = larger(best, gap);
    squares_of_box += squareIfPositive(gap);
  }
  const Floats root = squareRoot(larger(squares, squares_of_box));
  best = root > Floats{} ? root : best;
  Floats reach = absolute(axes[0].dot(direction)) * half[0] + absolute(axes[1].dot(direction)) * half[1] +
                 absolute(axes[2].dot(direction)) * half[2] + spread.along(direction);
  for (int j = 0; j < 3; ++j) {
    const float cosine = direction[0] * box.axis[j][0] + direction[1] * box.axis[j][1] + direction[2] * box.axis[j][2];
    reach += (cosine < 0.0F ? -cosine : cosine) * box.half[j];
  }
  best = larger(best, absolute(way.dot(direction)) - absolute(moved.dot(direction)) - reach);
  best -= load(node.radius) + box.radius + motion.any + spread.most;
  store(best, found.gaps.data());
  const Ints apart = best > cut;
  found.near = bitsOf(~apart);
  found.least_other = std::min(leastOf(apart ? best : Floats{} + kFar), kFar);
}

}  // namespace

SDF_CCD_LANES void boxGaps(const BoxTree::Node& node, const PlacedBox& box, const std::array<float, 3>& direction,
                           const BoxMotion& motion, float cut, NearBoxes& found) {
  gaps(node, box, direction, motion, InAnyDirection{motion.any_per_reach * load(node.reach)}, cut, found);
}

SDF_CCD_LANES void directedBoxGaps(const BoxTree::Node& node, const PlacedBox& box,
                                   const std::array<float, 3>& direction, const BoxMotion& motion, float cut,
                                   NearBoxes& found) {
  OfNode spread;
  for (int k = 0; k < 3; ++k) {
    const Vectors axis = load(node.axis[k]);
    spread.spread[k] =
        Vectors{axis.dot(motion.turn[0]), axis.dot(motion.turn[1]), axis.dot(motion.turn[2])} * load(node.half[k]);
  }
  gaps(node, box, direction, motion, spread, cut, found);
}

SDF_CCD_LANES void directedBoxGaps(const BoxTree::Node& node, const PlacedBox& box,
                                   const std::array<float, 3>& direction, const BoxMotion& motion,
                                   const std::array<std::array<float, 3>, 3>& spread, float cut, NearBoxes& found) {
  gaps(node, box, direction, motion, OfOtherBox{spread}, cut, found);
}

SDF_CCD_LANES void boxSupports(const BoxTree::Node& node, const std::array<float, 3>& direction,
                               const MotionAlong& motion, Lane& supports) {
  const std::array<float, 3>& turn = motion.turn;
  const Vectors center = load(node.center);
  Floats support = center.dot(direction) + absolute(center.dot(turn) + motion.shift) + load(node.radius) + motion.any;
  for (int i = 0; i < 3; ++i) {
    const Vectors axis = load(node.axis[i]);
    support += (absolute(axis.dot(direction)) + absolute(axis.dot(turn))) * load(node.half[i]);
  }
  store(support, supports.data());
}

}  // namespace sdf_ccd
