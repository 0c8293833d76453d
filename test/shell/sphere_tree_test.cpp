#include "shell/point_shell.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "oracle/shapes.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::sphere_tree_test {

PointShell shellOf(const std::vector<Vector3d>& points) {
  PointShell shell;
  for (const Vector3d& p : points) shell.add(p, Vector3d::UnitZ(), float(shell.size()));  // the area identifies it
  return shell;
}

std::vector<Vector3d> randomPoints(int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.emplace_back(uniform(random), uniform(random), uniform(random));
  return points;
}

void expectSound(const SphereTree& tree, const PointShell& shell) {
  ASSERT_FALSE(tree.nodes.empty());
  EXPECT_EQ(tree.nodes[0].begin, 0);
  EXPECT_EQ(tree.nodes[0].end, static_cast<int>(shell.size()));
  std::vector<int> in_leaves(shell.size(), 0);
  int next_child = 1;
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const SphereTree::Node& node = tree.nodes[n];
    for (int i = node.begin; i < node.end; ++i) {
      ASSERT_LE((shell.point(i) - node.ball().center).norm(), node.ball().radius);
      if (node.isLeaf()) ++in_leaves[i];
    }
    if (node.isLeaf()) {
      EXPECT_LE(node.end - node.begin, 16);
      continue;
    }
    EXPECT_GT(node.end - node.begin, 16);
    EXPECT_EQ(node.first_child, next_child) << "children of neighbours are neighbours";
    next_child += 2;
    int next = node.begin;
    for (int child = node.first_child; child < node.first_child + 2; ++child) {
      EXPECT_EQ(tree.nodes[child].begin, next);
      next = tree.nodes[child].end;
    }
    EXPECT_EQ(next, node.end);
  }
  EXPECT_EQ(std::count(in_leaves.begin(), in_leaves.end(), 1), static_cast<int>(shell.size()));
}

TEST(SphereTree, HoldsAllPointsOnceAndNests) {
  PointShell shell = shellOf(randomPoints(5000));
  const PointShell before = shell;
  const SphereTree tree = buildSphereTree(shell);
  expectSound(tree, shell);
  // The areas were reordered with their points.
  for (std::size_t i = 0; i < shell.size(); ++i) {
    EXPECT_EQ(shell.point(i), before.point(static_cast<std::size_t>(shell.areas[i])));
  }
}

TEST(SphereTree, NoPointGivesNoNode) {
  PointShell shell;
  EXPECT_TRUE(buildSphereTree(shell).nodes.empty());
}

TEST(SphereTree, OnePointIsALeafOfNoRadius) {
  PointShell shell = shellOf({{1, 2, 3}});
  const SphereTree tree = buildSphereTree(shell);
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].radius, 0);
  EXPECT_EQ(tree.nodes[0].center, Vector3f(1, 2, 3));
  expectSound(tree, shell);
}

TEST(SphereTree, DuplicatesAndLines) {
  PointShell same = shellOf(std::vector<Vector3d>(1000, Vector3d(0.1, 0.2, 0.3)));
  expectSound(buildSphereTree(same), same);
  std::vector<Vector3d> line;
  for (int i = 0; i < 1000; ++i) line.emplace_back(0.001 * i, -0.002 * i, 1e5);
  PointShell collinear = shellOf(line);
  const SphereTree tree = buildSphereTree(collinear);
  expectSound(tree, collinear);
  EXPECT_NEAR(tree.nodes[0].radius, (line.front() - line.back()).norm() / 2, 1e-6);
}

TEST(SphereTree, SpheresAreTight) {
  ShellOptions options;
  options.spacing = 0.05;
  PointShell ball = sampleSurface(Primitive(Sphere{1}), options);
  const SphereTree tree = buildSphereTree(ball);
  expectSound(tree, ball);
  EXPECT_LT(tree.nodes[0].radius, 1.001);
  PointShell box = sampleSurface(Primitive(Box::fromSize({2, 1.0, 0.5})), options);
  EXPECT_LT(buildSphereTree(box).nodes[0].radius, 1.001 * Vector3d(1, 0.5, 0.25).norm());
}

/// Centres are rounded to single precision: radii are about the rounded ones, also far from the origin, where these are
/// coarse, and for sizes beyond single precision.
TEST(SphereTree, HoldsPointsThatSinglePrecisionRounds) {
  for (const double scale : {1e-60, 1e-9, 1.0, 1e9, 1e60}) {
    for (const double away : {0.0, 1e-3, 1e6}) {
      PointShell shell;
      for (const Vector3d& p : randomPoints(100))
        shell.add(scale * (p + Vector3d::Constant(away)), Vector3d::UnitZ(), 1.0F);
      expectSound(buildSphereTree(shell), shell);
    }
  }
  PointShell point;
  point.add({0.1, 0.2, 1e-50}, Vector3d::UnitZ(), 1.0F);
  expectSound(buildSphereTree(point), point);
}

TEST(SphereTree, IsTheSameEveryTime) {
  PointShell a = shellOf(randomPoints(500)), b = a;
  const SphereTree first = buildSphereTree(a), second = buildSphereTree(b);
  EXPECT_EQ(a.points(), b.points());
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  for (std::size_t i = 0; i < first.nodes.size(); ++i) EXPECT_EQ(first.nodes[i].radius, second.nodes[i].radius);
}

}  // namespace sdf_ccd::sphere_tree_test
