// Points that are deep together. Expected values: sums over all points, with distances and normals of the solids by
// hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "contact/penalty.h"
#include "contact/point_groups.h"
#include "oracle/contact_case.h"
#include "oracle/random.h"
#include "oracle/rounds.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::point_groups_test {

using namespace test;

/// A solid that the shell is deep inside of.
struct Inside {
  Primitive primitive;
  double (*depth)(const Vector3d& p);
  Vector3d (*out)(const Vector3d& p);
};

constexpr double kRadius = 2.0, kHalf = 1.5;

const Inside kGround{HalfSpace{Vector3d::UnitZ(), 0.0}, [](const Vector3d& p) { return -p.z(); },
                     [](const Vector3d&) { return Vector3d(Vector3d::UnitZ()); }};
const Inside kBall{Sphere{kRadius}, [](const Vector3d& p) { return kRadius - p.norm(); },
                   [](const Vector3d& p) { return Vector3d(p.normalized()); }};
const Inside kRoom{Box::fromSize(Vector3d::Constant(2.0 * kHalf)),
                   [](const Vector3d& p) { return kHalf - p.cwiseAbs().maxCoeff(); },
                   [](const Vector3d& p) {
                     int axis;
                     p.cwiseAbs().maxCoeff(&axis);
                     return Vector3d(std::copysign(1.0, p[axis]) * Vector3d::Unit(axis));
                   }};

/// A shell inside a field, and what the points that a query finds there are divided into.
struct DeepCase {
  DeepCase(const Inside& in, const Primitive& of, double spacing, const Isometry3d& start, const Isometry3d& end)
      : solid(in), field(in.primitive), path(oneChord(1.0, start, end)) {
    ShellOptions options;
    options.spacing = spacing;
    shell = sampleSurface(of, options);
    tree = buildSphereTree(shell);
    sums = nodeSums(shell, tree);
    shellIntervals(field, shell, tree, path, query);
    groups.divide(field, {shell, tree, sums}, path, query, points);
  }

  Wrench grouped() {
    const std::vector<Isometry3d> still(2, Isometry3d::Identity());
    ContactImpulse of_groups, of_points;
    integrateContact({field, groups.shell(), path, still, {}}, groups.hits(), perArea(), {}, of_groups);
    integrateContact({field, shell, path, still, {}}, points, perArea(), {}, of_points);
    Wrench sum = of_groups.on_shell_body;
    return sum += of_points.on_shell_body;
  }

  /// At the chord's start. @param size  set to the sum of the forces' amounts.
  Wrench byAllPoints(double& size) const {
    Wrench sum;
    size = 0.0;
    for (std::size_t i = 0; i < shell.size(); ++i) {
      const Vector3d p = path.chords[0].X_FP_start * shell.point(i);
      const Vector3d force = kStiffness * double(shell.areas[i]) * std::max(0.0, solid.depth(p)) * solid.out(p);
      sum += {force, p.cross(force)};
      size += force.norm();
    }
    return sum;
  }

  const Inside& solid;
  DistanceField field;
  ChordPath path;
  PointShell shell;
  SphereTree tree;
  std::vector<NodeSum> sums;
  ShellQueryResult query;
  PointGroups groups;
  std::vector<ShellHit> points;
};

const Primitive kLink = Box::fromSize({0.1, 0.16, 0.6});

Isometry3d deepPose(Random& random, double depth) {
  Isometry3d X = pose(random, kPi, 0.3);
  X.translation().z() -= depth;
  return X;
}

TEST(PointGroups, BearTheForceOfTheirPoints) {
  Random random(3);
  for (const Inside* solid : {&kGround, &kBall, &kRoom}) {
    for (int i = 0; i < rounds(30); ++i) {
      const Isometry3d X = deepPose(random, uniform(random, 0.0, 1.2));
      DeepCase deep(*solid, i % 2 ? kLink : Primitive(Sphere{0.2}), 0.005, X, X);
      double force;
      const Wrench expected = deep.byAllPoints(force), found = deep.grouped();
      if (force == 0.0) continue;
      // In the room the nearest face changes within groups, near the ball's centre its direction: up to 5 and 0.8 % of
      // all forces' amounts in these cases. Elsewhere forces are exact.
      const double error = solid == &kRoom ? 0.08 : solid == &kBall ? 0.015 : 1e-5;
      EXPECT_LT((found.force - expected.force).norm(), error * force) << i;
      const Vector3d arm = X.translation();  // about the shell's middle
      const Vector3d torque_error =
          (found.torque - arm.cross(found.force)) - (expected.torque - arm.cross(expected.force));
      EXPECT_LT(torque_error.norm(), std::max(0.02, error) * 0.3 * force) << i;
    }
  }
}

TEST(PointGroups, AreNoMoreWhereThereAreMorePoints) {
  Random random(4);
  const Isometry3d X = deepPose(random, 1.0);
  DeepCase coarse(kGround, kLink, 0.004, X, X), fine(kGround, kLink, 0.002, X, X);
  const auto count = [](const DeepCase& deep) { return deep.groups.groups().size() + deep.points.size(); };
  EXPECT_GT(coarse.shell.size(), 5000u);
  EXPECT_GT(fine.shell.size(), 3 * coarse.shell.size());
  EXPECT_LT(count(coarse), 1000u);
  EXPECT_LT(double(count(fine)), 1.3 * double(count(coarse)));
}

TEST(PointGroups, StandForEachPointThatIsInsideOnce) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const Isometry3d X = deepPose(random, uniform(random, 0.0, 0.3));
    DeepCase deep(kGround, kLink, 0.005, X, X);
    std::vector<int> found(deep.shell.size(), 0), expected(deep.shell.size(), 0);
    for (const ShellHit& hit : deep.points) ++found[hit.point];
    for (const PointGroups::Group& group : deep.groups.groups())
      for (int p = deep.tree.nodes[group.node].begin; p < deep.tree.nodes[group.node].end; ++p) ++found[p];
    for (std::size_t p = 0; p < expected.size(); ++p) expected[p] = kGround.depth(X * deep.shell.point(p)) >= 0.0;
    EXPECT_EQ(found, expected);
  }
}

/// Depths of all points, sampled along a motion.
TEST(PointGroups, KnowHowDeepTheirPointsGet) {
  Random random(6);
  for (const Inside* solid : {&kGround, &kBall, &kRoom}) {
    for (int i = 0; i < 20; ++i) {
      const Isometry3d start = deepPose(random, 0.8), end = start * pose(random, 0.05, 0.03);
      DeepCase deep(*solid, kLink, 0.006, start, end);
      std::vector<ShellHit> shown;
      deep.groups.findDeep(deep.field, {deep.shell, deep.tree, deep.sums}, deep.path, 0.0, shown);
      const auto depthOf = [&](int p) {
        double depth = 0.0;
        for (int k = 0; k <= 20; ++k) {
          const Vector3d p_P = deep.shell.point(std::size_t(p)), a = start * p_P, b = end * p_P;
          depth = std::max(depth, solid->depth(a + k / 20.0 * (b - a)));
        }
        return depth;
      };
      double deepest = 0.0, deepest_shown = 0.0, reach = 0.0;
      for (const PointGroups::Group& group : deep.groups.groups()) {
        const SphereTree::Node& node = deep.tree.nodes[group.node];
        double depth = 0.0;
        for (int p = node.begin; p < node.end; ++p) depth = std::max(depth, depthOf(p));
        EXPECT_LE(depth, group.reach + 1e-6);
        deepest = std::max(deepest, depth);
        reach = std::max(reach, group.reach);
      }
      for (const ShellHit& hit : shown) deepest_shown = std::max(deepest_shown, depthOf(hit.point));
      EXPECT_NEAR(deepest_shown, deepest, 0.002 * deepest);
      EXPECT_LT(reach, deepest + 0.02);  // half of a point's path
    }
  }
}

}  // namespace sdf_ccd::point_groups_test
