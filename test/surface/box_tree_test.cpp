#include "surface/box_tree.h"

#include <gtest/gtest.h>

#include <set>

#include "oracle/random.h"
#include "oracle/rounded_triangles.h"
#include "oracle/shapes.h"

namespace sdf_ccd::box_tree_test {

using test::distance;
using test::Random;
using test::Real;
using test::Vector3r;

/// Triangles of all shapes: some without area, some only points.
std::vector<RoundedTriangle> drawn(Random& random, int count, double size, const Vector3d& offset) {
  std::vector<RoundedTriangle> all;
  for (int i = 0; i < count; ++i) {
    RoundedTriangle t;
    const Vector3d at = offset + size * test::direction(random);
    for (Vector3d& p : t.corners) p = at + size * test::uniform(random, 0.0, 0.3) * test::direction(random);
    if (i % 5 == 0) t.corners[2] = 0.5 * (t.corners[0] + t.corners[1]);
    if (i % 7 == 0) t.corners[1] = t.corners[2] = t.corners[0];
    if (i % 3 == 0) t.radius = size * test::uniform(random, 0.0, 0.1);
    all.push_back(t);
  }
  return all;
}

/// Visits the boxes of a tree with the triangles below them.
template <typename Visit>
std::vector<int> forEachBox(const BoxTree& tree, BoxTree::Slot slot, const Visit& visit) {
  std::vector<int> triangles;
  const std::int32_t below = tree.node(slot.node).below[slot.lane];
  if (BoxTree::isTriangle(below)) {
    triangles.push_back(BoxTree::triangleOf(below));
  } else {
    for (std::int32_t i = 0; i < tree.node(below).count; ++i)
      for (const int t : forEachBox(tree, {below, i}, visit)) triangles.push_back(t);
  }
  visit(slot, triangles);
  return triangles;
}

TEST(BoxTree, BoxesHoldTheirTrianglesAndEveryTriangleIsInOne) {
  Random random(1);
  for (const int count : {1, 2, 7, 8, 9, 64, 65, 500}) {
    const BoxTree tree(drawn(random, count, 0.3, {1, 2, 3}));
    const std::vector<int> all = forEachBox(tree, tree.root(), [&](BoxTree::Slot slot, const std::vector<int>& below) {
      const BoxTree::Node& node = tree.node(slot.node);
      for (const int i : below)
        for (const Vector3d& p : tree.triangle(i).corners) {
          Vector3r q = (p - tree.origin()).cast<Real>();
          for (int k = 0; k < 3; ++k) q[k] -= node.center[k][slot.lane];
          EXPECT_LE(q.norm() + tree.triangle(i).radius, node.reach[slot.lane]);
          for (int axis = 0; axis < 3; ++axis) {
            Real along = 0;
            for (int k = 0; k < 3; ++k) along += q[k] * node.axis[axis][k][slot.lane];
            EXPECT_LE(std::abs(along), node.half[axis][slot.lane]);
          }
          EXPECT_LE(tree.triangle(i).radius, node.radius[slot.lane]);
        }
    });
    EXPECT_EQ(int(all.size()), count);
    EXPECT_EQ(std::set<int>(all.begin(), all.end()).size(), all.size());
  }
}

TEST(BoxTree, MeshesOfOneTriangleAndOfEqualOnesAreTrees) {
  const RoundedTriangle t{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}, 0.0};
  EXPECT_EQ(BoxTree({t}).size(), 1U);
  EXPECT_EQ(BoxTree(std::vector<RoundedTriangle>(100, t)).size(), 100U);
  EXPECT_THROW(BoxTree({}), std::invalid_argument);
}

/// Compared with every triangle below either box, in long double; the error by rounding is within kBoxRounding.
TEST(BoxTree, GapsAreNoMoreThanDistances) {
  Random random(2);
  Real worst = 0;
  double tightest = 1e300;
  for (int trial = 0; trial < 300; ++trial) {
    const double size = trial % 2 ? 0.3 : 20.0;
    const BoxTree tree(drawn(random, 60, size, size * test::direction(random)));
    const RoundedTriangle other = drawn(random, 1, size, tree.origin() + 2.5 * size * test::direction(random))[0];
    const BoxTree single({other});
    // Placed without a rotation.
    const BoxTree::Node& root = single.node(0);
    const Vector3d between = single.origin() - tree.origin();
    PlacedBox box;
    for (int k = 0; k < 3; ++k) {
      box.center[k] = float(between[k]) + root.center[k][0];
      box.half[k] = root.half[k][0];
      for (int j = 0; j < 3; ++j) box.axis[k][j] = root.axis[k][j][0];
    }
    box.radius = root.radius[0];
    box.reach = root.reach[0];
    const Vector3d n = test::direction(random);
    const std::array<float, 3> direction = {float(n.x()), float(n.y()), float(n.z())};
    const double rounding = kBoxRounding * (tree.ball().radius + single.ball().radius + between.norm());
    forEachBox(tree, tree.root(), [&](BoxTree::Slot slot, const std::vector<int>& below) {
      NearBoxes found;
      boxGaps(tree.node(slot.node), box, direction, BoxMotion{}, 0.01F, found);
      const BoxTree::Node::Lane& gaps = found.gaps;
      EXPECT_EQ((found.near >> slot.lane & 1U) != 0, gaps[slot.lane] <= 0.01F);
      EXPECT_TRUE(gaps[slot.lane] <= 0.01F || gaps[slot.lane] >= found.least_other);
      Real nearest = 1e300L;
      for (const int i : below) nearest = std::min(nearest, distance(tree.triangle(i), other));
      EXPECT_LE(gaps[slot.lane] - rounding, std::max<Real>(nearest, 0));
      if (gaps[slot.lane] > 0) worst = std::max(worst, (gaps[slot.lane] - nearest) / Real(rounding));
      if (below.size() == 1) tightest = std::min(tightest, double(nearest) - gaps[slot.lane]);
    });
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_LT(tightest, 1e-3) << "some gap is nearly the distance";
}

/// A cube at the origin, in a node of its own, and another one, with axes along the coordinates.
struct TwoCubes {
  BoxTree::Node node{};
  PlacedBox box{};

  TwoCubes(float half_of_node, float half_of_box, const std::array<float, 3>& center_of_box) {
    node.radius.fill(-1e30F);
    node.radius[0] = 0.0F;
    node.count = 1;
    for (int k = 0; k < 3; ++k) {
      node.axis[k][k].fill(box.axis[k][k] = 1.0F);
      node.half[k][0] = half_of_node;
      box.half[k] = half_of_box;
    }
    box.center = center_of_box;
  }
};

/// The root sum of squares of the gaps along three orthogonal axes, where the boxes face each other with corners.
TEST(BoxTree, GapsOfBoxesAtACornerAreTheirDistance) {
  const Vector3d d(0.3, 0.4, 1.2);
  const auto [node, box] = TwoCubes(0.2F, 0.1F, {float(0.3 + d.x()), float(0.3 + d.y()), float(0.3 + d.z())});
  NearBoxes found;
  boxGaps(node, box, {1, 0, 0}, BoxMotion{}, 0.0F, found);
  EXPECT_NEAR(found.gaps[0], d.norm(), 1e-6);
  // A shift along x brings the boxes nearer along x alone; other motions in all directions.
  boxGaps(node, box, {1, 0, 0}, BoxMotion{{0.3F, 0, 0}, {}, 0.01F, 0.0F}, 0.0F, found);
  EXPECT_NEAR(found.gaps[0], std::hypot(d.y(), d.z()) - 0.01, 1e-6);
}

/// Boxes that turn about the axis along which they are apart stay as far apart, whichever of them turns.
TEST(BoxTree, GapsOfBoxesThatTurnOnEachOtherAreTheirDistance) {
  auto [node, box] = TwoCubes(0.2F, 0.2F, {0, 0, 0.41F});
  node.reach[0] = box.reach = 0.35F;
  const std::array<std::array<float, 3>, 3> turn = {{{0, -0.1F, 0}, {0.1F, 0, 0}, {}}},
                                            spread = {{{0, 0.02F, 0}, {-0.02F, 0, 0}, {}}};
  NearBoxes found;
  directedBoxGaps(node, box, {1, 0, 0}, BoxMotion{{}, turn, 0.0F, 0.1F}, 0.0F, found);
  EXPECT_NEAR(found.gaps[0], 0.01, 1e-6);
  directedBoxGaps(node, box, {1, 0, 0}, BoxMotion{{}, {}, 0.0F, 0.1F}, spread, 0.0F, found);
  EXPECT_NEAR(found.gaps[0], 0.01, 1e-6);
}

/// For points that move by no more than the motion's bounds.
TEST(BoxTree, GapsAndSupportsHoldAllAlongAMotion) {
  Random random(3);
  const auto single = [](const Vector3d& v) { return std::array<float, 3>{float(v.x()), float(v.y()), float(v.z())}; };
  for (int trial = 0; trial < 200; ++trial) {
    const BoxTree tree(drawn(random, 40, 0.3, Vector3d::Zero()));
    const RoundedTriangle other = drawn(random, 1, 0.3, 0.8 * test::direction(random))[0];
    const BoxTree one({other});
    const Vector3d between = one.origin() - tree.origin(), n = test::direction(random);
    PlacedBox box{};
    for (int k = 0; k < 3; ++k) {
      box.center[k] = float(between[k]) + one.node(0).center[k][0];
      box.half[k] = one.node(0).half[k][0];
      for (int j = 0; j < 3; ++j) box.axis[k][j] = one.node(0).axis[k][j][0];
    }
    box.radius = one.node(0).radius[0];
    box.reach = one.node(0).reach[0];
    // In both directions: a translation and a rotation about the tree's origin.
    const Vector3d shift = 0.05 * test::direction(random), omega = 0.05 * test::direction(random);
    Matrix3d turn;
    turn << 0, -omega.z(), omega.y(), omega.z(), 0, -omega.x(), -omega.y(), omega.x(), 0;
    BoxMotion motion{single(shift),
                     {single(turn.row(0)), single(turn.row(1)), single(turn.row(2))},
                     0.0F,
                     float(omega.norm() * 1.0001)};
    const MotionAlong along{float(n.dot(shift)), single(turn.transpose() * n), 0.0F};
    const double rounding = kBoxRounding * (tree.ball().radius + one.ball().radius + between.norm());
    forEachBox(tree, tree.root(), [&](BoxTree::Slot slot, const std::vector<int>& below) {
      NearBoxes found, found_directed;
      BoxTree::Node::Lane supports;
      boxGaps(tree.node(slot.node), box, single(n), motion, 0.0F, found);
      const BoxTree::Node::Lane& gaps = found.gaps;
      directedBoxGaps(tree.node(slot.node), box, single(n), motion, 0.0F, found_directed);
      boxSupports(tree.node(slot.node), single(n), along, supports);
      for (const double side : {-1.0, -0.3, 1.0})
        for (const int i : below) {
          RoundedTriangle t = tree.triangle(i);
          for (Vector3d& p : t.corners) {
            p += side * (shift + omega.cross(p - tree.origin()));
            EXPECT_LE(n.dot(p - tree.origin()) + t.radius - rounding, supports[slot.lane]);
          }
          const Real truth = std::max<Real>(distance(t, other), 0);
          EXPECT_LE(gaps[slot.lane] - rounding, truth);
          EXPECT_LE(found_directed.gaps[slot.lane] - rounding, truth);
        }
      // The same motion of the other box instead, about its center.
      std::array<std::array<float, 3>, 3> spread;
      Vector3d center;
      for (int k = 0; k < 3; ++k) {
        center[k] = one.origin()[k] + double(one.node(0).center[k][0]);
        spread[k] = single(omega.cross(Vector3d(box.axis[k][0], box.axis[k][1], box.axis[k][2])) * double(box.half[k]));
      }
      directedBoxGaps(tree.node(slot.node), box, single(n), {single(shift), {}, 0.0F, 0.0F}, spread, 0.0F,
                      found_directed);
      for (const double side : {-1.0, -0.3, 1.0}) {
        RoundedTriangle moved = other;
        for (Vector3d& p : moved.corners) p += side * (shift + omega.cross(p - center));
        for (const int i : below)
          EXPECT_LE(found_directed.gaps[slot.lane] - rounding, std::max<Real>(distance(tree.triangle(i), moved), 0));
      }
    });
  }
}

TEST(BoxTree, OfALargeMeshIsMadeInNoTimeAndSmall) {
  const BoxTree tree(test::roundedTriangles(test::torusMesh(0.5, 0.1, 200, 50)));
  EXPECT_EQ(tree.size(), 20000U);
  EXPECT_LT(tree.bytes(), 20000U * 400U);
}

}  // namespace sdf_ccd::box_tree_test
