#include "shell/point_shell.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "mesh/triangle_tree.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "shell/sample_surface.h"
#include "shell/sampled_points.h"

namespace sdf_ccd::point_shell_test {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;

constexpr double kSinglePrecision = 0x1p-24;  ///< relative rounding error

/// Random points in a ball.
SampledPoints pointsIn(const BoundingBall& ball, int count) {
  test::Random random(3);
  SampledPoints sampled;
  for (int i = 0; i < count; ++i) {
    sampled.points.push_back(ball.center + ball.radius * test::uniform(random, 0.0, 1.0) * test::direction(random));
    sampled.normals.push_back(Vector3f::UnitX());
    sampled.areas.push_back(1.0F);
  }
  return sampled;
}

/// The largest distance of a shell's points from those that they were rounded from.
double displacement(const PointShell& shell, const SampledPoints& sampled) {
  Real largest = 0.0;
  for (std::size_t i = 0; i < shell.size(); ++i) {
    const Point exact = shell.origin.cast<Real>() + shell.offsets[i].cast<Real>();
    largest = std::max(largest, (exact - sampled.points[i].cast<Real>()).norm());
  }
  return static_cast<double>(largest);
}

/// An offset o is rounded by at most 2^-24 |o|, each coordinate by its share; of random ones, one is nearly so. Double
/// precision of the position itself is added.
TEST(PointShell, ErrorIsRelativeToTheSizeWhereverItIs) {
  for (const double size : {1e-6, 1e-3, 0.1, 30.0, 1e6}) {
    for (const double away : {0.0, 1.0, 1e6}) {
      const Vector3d center = away * Vector3d(0.3, -1.0, 0.7);
      const SampledPoints sampled = pointsIn({center, size}, 5000);
      const PointShell shell = toShell(sampled);
      const double found = displacement(shell, sampled), in_double = 4e-16 * (away + size);
      EXPECT_LE(found, shell.position_error + in_double) << size << " " << away;
      EXPECT_LE(shell.position_error, 1.1 * kSinglePrecision * size + in_double) << size << " " << away;
      // Far away, the positions to be rounded have few bits left.
      if (in_double < kSinglePrecision * size) {
        EXPECT_GE(shell.position_error, 0.4 * kSinglePrecision * size) << size << " " << away;
      }
    }
  }
}

TEST(PointShell, PointsOfFewBitsAreExact) {
  PointShell shell;
  for (const Vector3d& p : {Vector3d(0.5, -0.25, 3.0), Vector3d(1e6, 0, 0)}) shell.add(p, Vector3d::UnitX(), 1.0F);
  EXPECT_EQ(shell.position_error, 0.0);
  EXPECT_EQ(shell.points(), (std::vector<Vector3d>{{0.5, -0.25, 3.0}, {1e6, 0, 0}}));
  PointShell far;
  far.origin = {1e9 + 0.1, 2e9, -3e9};
  far.add(far.origin, Vector3d::UnitX(), 1.0F);
  EXPECT_EQ(far.position_error, 0.0);
  EXPECT_EQ(far.point(0), far.origin);
}

TEST(PointShell, ErrorHoldsBeyondSinglePrecision) {
  PointShell shell;
  shell.add({1e60, 0.0, 0.0}, Vector3d::UnitX(), 1.0F);
  EXPECT_GE(shell.position_error, 0.99e60);
  EXPECT_TRUE(shell.point(0).allFinite());
}

TEST(PointShell, RadiiAllowForRounding) {
  SampledPoints sampled = pointsIn({{1.0, 2.0, 3.0}, 0.3}, 100);
  sampled.covering_radius = 0.02;
  sampled.edge_radius = 0.01;
  sampled.flatness = 0.001;
  const PointShell shell = toShell(sampled);
  EXPECT_GT(shell.position_error, 0.0);
  EXPECT_EQ(shell.covering_radius, 0.02 + shell.position_error);
  EXPECT_EQ(shell.edge_radius, 0.01 + shell.position_error);
  EXPECT_EQ(shell.flatness, 0.001);
}

/// A mesh a thousand times its size away from the origin: points keep to it as closely as those of one at the origin.
TEST(PointShell, PointsOfASurfaceFarAwayLieOnIt) {
  const Vector3d away(1000.0, -2000.0, 500.0);
  ShellOptions options;
  options.spacing = 0.1;
  for (const Vector3d& shift : {Vector3d(Vector3d::Zero()), away}) {
    const TriangleMesh mesh = test::translated(test::icosphere(0.5, 2), shift);
    const TriangleTree tree(mesh);
    const PointShell shell = sampleSurface(mesh, options);
    double off = 0.0;
    for (const Vector3d& p : shell.points()) off = std::max(off, tree.closestPoint(p).distance);
    EXPECT_LE(off, shell.position_error + 1e-12);
    EXPECT_LE(shell.position_error, 1.01 * kSinglePrecision * 0.5 + 1e-12);
  }
}

}  // namespace sdf_ccd::point_shell_test
