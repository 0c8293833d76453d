#include "field/gradient_bound.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "field/near_octants.h"
#include "field/trilinear_cell.h"
#include "field/uniform/sparse_grid.h"
#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::gradient_bound_test {

using test::Random;

/// Compares interpolants in small cubes near a mesh with the exact distance at points all over the cube.
class GradientBoundTest : public testing::Test {
 protected:
  struct Seen {
    double bound, error;
  };

  Seen compare(const SurfaceIndex& index, const SpaceCube& cube, double wrong) {
    const SignedSurface& surface = index.exact();
    // The cube is the first octant of a larger one, as lists of octants contain only triangles that may be nearest.
    const Vector3d around = cube.corner(7);
    const NearCube found(index, {around, 2.0 * cube.side}, surface.nearest(around));
    NearOctants octants(found.near());
    GradientBound::CornerValues exact, values;
    for (int k = 0; k < 8; ++k) {
      exact[k] = surface.signedDistance(cube.corner(k));
      values[k] = exact[k] + test::uniform(random_, -wrong, wrong);
    }
    Seen seen{GradientBound(octants[0]).deviation(cube.side, exact, values).largest(), 0.0};
    constexpr int kSteps = 6;
    for (int i = 0; i < (kSteps + 1) * (kSteps + 1) * (kSteps + 1); ++i) {
      const Vector3d u =
          Vector3d(i % (kSteps + 1), i / (kSteps + 1) % (kSteps + 1), i / (kSteps + 1) / (kSteps + 1)) / kSteps;
      const Vector3d p = cube.corner(0) + cube.side * u;
      seen.error = std::max(seen.error, std::abs(trilinear(values, u) - surface.signedDistance(p)));
    }
    return seen;
  }

  /// In cubes about random points of the surface's box.
  void expectHolds(const TriangleMesh& mesh, double side, double wrong) {
    const SurfaceIndex index(mesh);
    const AlignedBox3d box = boundingBox(mesh);
    int with_error = 0;
    for (int i = 0; i < 400; ++i) {
      const Seen seen = compare(index, {test::uniformIn(random_, box), test::uniform(random_, 0.2, 1.0) * side}, wrong);
      EXPECT_LE(seen.error, seen.bound + 1e-12);
      with_error += seen.error > 1e-9;
    }
    EXPECT_GT(with_error, 0);
  }

  Random random_{5};
};

TEST_F(GradientBoundTest, HoldsOnSmallTriangles) {
  expectHolds(test::icosphere(0.3, 3), 0.1, 0.0);
}

TEST_F(GradientBoundTest, HoldsForAnyInterpolant) {
  expectHolds(test::boxMesh({0.2, 0.15, 0.1}), 0.1, 0.02);
}

TEST_F(GradientBoundTest, HoldsWhereNoConeHoldsTheGradients) {
  expectHolds(test::boxMesh({0.2, 0.15, 1e-4}), 0.05, 0.0);
}

TEST_F(GradientBoundTest, IsZeroOverFlatFaces) {
  const TriangleMesh mesh = test::boxMesh({0.2, 0.15, 0.1});
  constexpr double kSide = 0.04, kSinglePrecision = 1e-5;
  EXPECT_LT(compare(SurfaceIndex(mesh), {{0.05, 0.02, 0.1}, kSide}, 0.0).bound, kSinglePrecision * kSide);
}

TEST_F(GradientBoundTest, IsTightAtAnEdge) {
  const TriangleMesh mesh = test::icosphere(0.3, 2);
  const SurfaceIndex index(mesh);
  std::vector<double> ratios;
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d on_edge = 0.5 * (mesh.vertices[t[0]] + mesh.vertices[t[1]]);
    const Seen seen = compare(index, {on_edge + 0.001 * test::direction(random_), 0.005}, 0.0);
    ratios.push_back(seen.bound / seen.error);
  }
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LT(ratios[ratios.size() / 2], 2.0);
}

}  // namespace sdf_ccd::gradient_bound_test
