#include "sdf_ccd/field.h"

#include <algorithm>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "field/field_access.h"
#include "field/grid_cell.h"
#include "field/trilinear_cell.h"
#include "field/uniform/sparse_grid.h"
#include "mesh/triangle_tree.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::distance_field_test {

using test::Random;

FieldOptions cells(int n) {
  FieldOptions options;
  options.cells = n;
  return options;
}

const Vector3d kHalf(0.3, 0.2, 0.1);

/// The field of a box's mesh: the primitive is the same solid, so the exact distance is known everywhere.
DistanceField boxField(int n) {
  return buildField(test::boxMesh(kHalf), cells(n));
}

/// Calls visit(brick, slot) for all bricks with samples.
template <class Visit>
void forEachSampled(const SparseGrid& grid, const Visit& visit) {
  const Vector3i bricks = grid.shape().bricks;
  for (Vector3i b(0, 0, 0); b.z() < bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < bricks.x(); ++b.x())
        if (const std::int32_t slot = grid.slot(b); slot != SparseGrid::kFar) visit(b, slot);
}

TEST(DistanceField, SamplesAreExactAtGridPointsToTheirRounding) {
  const DistanceField field = boxField(40);
  const SparseGrid& grid = *FieldAccess::grid(field);
  const GridShape& shape = grid.shape();
  double worst = 0.0;
  int seen = 0;
  forEachSampled(grid, [&](const Vector3i& b, std::int32_t slot) {
    for (const Vector3i& place : {Vector3i(3, 5, 1), Vector3i(8, 0, 8), Vector3i(7, 8, 4)}) {
      const Vector3d p = shape.origin + shape.cell * (8 * b + place).cast<double>();
      const double error =
          std::abs(grid.sample(slot, place) - signedDistance(Primitive(Box::fromSize(2.0 * kHalf)), p));
      ASSERT_LE(error, grid.rounding() + 1e-7);
      worst = std::max(worst, error);
      ++seen;
    }
    const std::array<double, 8> corners = grid.cellCorners(slot, {3, 5, 7});
    for (int k = 0; k < 8; ++k) {
      ASSERT_EQ(corners[k], grid.sample(slot, Vector3i(3 + (k & 1), 5 + (k >> 1 & 1), 7 + (k >> 2))));
    }
  });
  EXPECT_GT(seen, 150);
  EXPECT_GE(worst, 0.9 * grid.rounding());
  EXPECT_GT(grid.rounding(), 1e-4 * shape.cell);
  EXPECT_LT(grid.rounding(), 1e-3 * shape.cell);
}

/// Without its lid the box's sign changes far from any triangle: still no sample may exceed the range of 16 bits.
TEST(DistanceField, SixteenBitsHoldAnOpenMeshsDistances) {
  TriangleMesh open = test::boxMesh(kHalf);
  open.triangles.resize(10);
  const DistanceField field = buildField(open, cells(128));
  const SparseGrid& grid = *FieldAccess::grid(field);
  double steepest = 0.0;  // per cell; a sample that overflowed would differ far more from its neighbours
  forEachSampled(grid, [&](const Vector3i& /*brick*/, std::int32_t slot) {
    for (int k = 0; k < GridShape::kSamples; ++k) {
      const Vector3i place(k % 9, k / 9 % 9, k / 81);
      for (int axis = 0; axis < 3; ++axis) {
        if (place[axis] == GridShape::kBrick) continue;
        const double a = grid.sample(slot, place), b = grid.sample(slot, place + Vector3i::Unit(axis));
        steepest = std::max(steepest, std::abs(std::abs(a) - std::abs(b)));
      }
    }
  });
  EXPECT_LE(steepest, grid.shape().cell + 2.0 * grid.rounding() + 1e-9);
  EXPECT_GT(steepest, 0.99 * grid.shape().cell);
}

/// Compares the error bound at random points with the error; half of the points are on the surface.
/// @return the median bound at the surface [cells].
double expectPlacesHonest(const TriangleMesh& mesh, const FieldOptions& options) {
  const DistanceField field = buildField(mesh, options);
  const TriangleTree tree(mesh);
  Random random(6);
  std::vector<double> bounds;
  for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
    const Vector3i& t = mesh.triangles[random() % mesh.triangles.size()];
    const Vector3d weights = test::uniformIn(random, {Vector3d::Zero(), Vector3d::Ones()});
    Vector3d p =
        (weights[0] * mesh.vertices[t[0]] + weights[1] * mesh.vertices[t[1]] + weights[2] * mesh.vertices[t[2]]) /
        weights.sum();
    const bool on_surface = i % 2 == 0;
    if (!on_surface) p += test::uniform(random, 0.0, 2.0 * field.band()) * test::direction(random);
    const double distance = on_surface ? 0.0 : tree.closestPoint(p).distance;
    const double exact = !on_surface && tree.windingNumber(p) > 0.5 ? -distance : distance;
    const FieldSample at = field.sample(p);
    EXPECT_LE(std::abs(at.value - exact), at.error + 1e-12) << p.transpose();
    EXPECT_EQ(field.interpolate(p).value, at.value);
    EXPECT_EQ(field.interpolate(p).gradient, at.gradient);
    if (on_surface) bounds.push_back(at.error / FieldAccess::grid(field)->shape().cell);
  }
  std::nth_element(bounds.begin(), bounds.begin() + bounds.size() / 2, bounds.end());
  return bounds[bounds.size() / 2];
}

TEST(DistanceField, SamplesAroundAPlaceBoundItsError) {
  EXPECT_LT(expectPlacesHonest(test::icosphere(0.3, 4), cells(40)), 0.05);
  EXPECT_LT(expectPlacesHonest(test::torusMesh(0.2, 0.08, 32, 16), cells(50)), 0.05);
  EXPECT_LT(expectPlacesHonest(test::boxMesh({0.2, 0.15, 0.1}), cells(30)), 0.03);
}

TEST(DistanceField, SamplesAroundAPlaceBoundItsErrorOnScansAndLinks) {
  SDF_CCD_NEEDS_DATA("meshes/bunny_lowres_npm.off");
  SDF_CCD_NEEDS_DATA("robots/pr2_description/urdf/meshes/forearm_v0/forearm.stl");
  for (const char* file :
       {"meshes/bunny_lowres_npm.off", "robots/pr2_description/urdf/meshes/forearm_v0/forearm.stl"}) {
    EXPECT_LT(expectPlacesHonest(orientOutward(loadMesh(test::dataPath(file))).mesh, cells(64)), 0.2) << file;
  }
}

TEST(DistanceField, ErrorBoundHoldsEverywhereAndIsReached) {
  const DistanceField field = boxField(40);
  const Primitive exact = Box::fromSize(2.0 * kHalf);
  Random random(1);
  double worst = 0.0, worst_share = 0.0;
  int in_band = 0, outside = 0;
  for (int i = 0; i < 300000; ++i) {
    const double size = i % 3 == 0 ? 3.0 : 0.4;
    const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-size), Vector3d::Constant(size)});
    const FieldSample at = field.sample(p);
    const double truth = signedDistance(exact, p), error = std::abs(at.value - truth);
    ASSERT_LE(error, at.error + 1e-12) << p.transpose();
    ASSERT_LE(field.lowerBound(p), truth + 1e-12) << p.transpose();
    if (std::abs(truth) <= field.band()) {
      ++in_band;
      ASSERT_LE(at.error, field.errorBound());
      worst = std::max(worst, error);
      worst_share = std::max(worst_share, error / at.error);
    }
    outside += !FieldAccess::grid(field)->shape().box().contains(p);
  }
  EXPECT_GT(in_band, 10000);
  EXPECT_GT(outside, 10000);
  // The interpolation error is largest at the box's edges; the bound must not be far above it.
  EXPECT_GT(worst, 0.2 * field.errorBound());
  EXPECT_GT(worst_share, 0.4);
}

TEST(DistanceField, LowerBoundGrowsWithTheDistanceOutside) {
  const DistanceField field = boxField(32);
  for (const double x : {1.0, 10.0, 1e3, 1e6}) {
    EXPECT_NEAR(field.lowerBound({x, 0, 0}), x - 0.3, 1e-9 * x);
    const FieldSample at = field.sample({x, 0, 0});
    EXPECT_GT(at.value, 0.0);
    EXPECT_LE(std::abs(at.value - (x - 0.3)), at.error + 1e-9 * x);
    EXPECT_NEAR(at.gradient.x(), 1.0, 1e-12);
  }
}

TEST(DistanceField, ErrorShrinksWithTheCell) {
  // On a smooth surface the interpolation error decreases with the square of the cell size.
  const double R = 0.5;
  const TriangleMesh mesh = test::icosphere(R, 5);
  double last = 0.0;
  for (const int n : {16, 32, 64}) {
    const DistanceField field = buildField(mesh, cells(n));
    Random random(2);
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p = test::uniform(random, 0.97, 1.03) * R * test::direction(random);
      sum += std::abs(field.sample(p).value - (p.norm() - R));
    }
    if (last > 0.0) {
      EXPECT_GT(last / sum, n == 32 ? 2.8 : 1.9) << n;
    }
    last = sum;
  }
}

TEST(DistanceField, GradientPointsOut) {
  const DistanceField field = boxField(64);
  const double rounding = 2.0 * FieldAccess::grid(field)->rounding() / FieldAccess::grid(field)->shape().cell + 1e-5;
  EXPECT_TRUE(field.sample({0.301, 0.02, 0.03}).gradient.isApprox(Vector3d(1, 0, 0), rounding));
  EXPECT_TRUE(field.sample({0.0, -0.199, 0.0}).gradient.isApprox(Vector3d(0, -1, 0), rounding));
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = test::uniformIn(random, {-kHalf, kHalf}), d = 1e-7 * test::direction(random);
    const FieldSample at = field.sample(p);
    EXPECT_NEAR(field.sample(p + d).value - field.sample(p - d).value, 2 * at.gradient.dot(d), 2e-8);
  }
}

TEST(DistanceField, MaximumErrorIsKept) {
  FieldOptions options;
  options.max_error = 0.004;
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  EXPECT_LE(field.errorBound(), 0.004 * (1 + 1e-4));
  EXPECT_GE(field.errorBound(), 0.004 * (1 - 1e-4));
  options.max_error.reset();
  options.cell_size = 0.01;
  EXPECT_EQ(FieldAccess::grid(buildField(test::boxMesh(kHalf), options))->shape().cell, 0.01);
}

TEST(DistanceField, BandIsAsWideAsAsked) {
  FieldOptions options = cells(32);
  options.band = 0.07;
  const DistanceField field = buildField(test::boxMesh(kHalf), options);
  EXPECT_EQ(field.band(), 0.07);
  const Primitive exact = Box::fromSize(2.0 * kHalf);
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const Vector3d p = test::uniformIn(random, {-1.5 * kHalf, 1.5 * kHalf});
    if (std::abs(signedDistance(exact, p)) <= 0.07) {
      ASSERT_LE(field.sample(p).error, field.errorBound());
    }
  }
}

TEST(DistanceField, SparseFieldFollowsTheSurface) {
  // Twice the resolution needs four times as many cells near the surface, not eight times.
  const TriangleMesh mesh = test::icosphere(0.5, 4);
  const auto coarse = FieldAccess::grid(buildField(mesh, cells(100)))->storedCells();
  const auto fine = FieldAccess::grid(buildField(mesh, cells(200)))->storedCells();
  EXPECT_GT(double(fine) / coarse, 3.0);
  EXPECT_LT(double(fine) / coarse, 5.0);
}

/// Design §3.3: with v the exact sample at c and h the cell, no point nearer to c than √((v − σ)² − ¾h²) is
/// interpolated to σ. If samples are rounded, |v − σ| is reduced by the rounding of v and of the samples around it.
TEST(DistanceField, NothingNearASampleIsInterpolatedToAnIsovalue) {
  const DistanceField field = boxField(40);
  const SparseGrid& grid = *FieldAccess::grid(field);
  const GridShape& shape = grid.shape();
  Random random(8);
  int tried = 0;
  double least = 1.0;
  while (tried < 200000) {
    const Vector3i b(random() % shape.bricks.x(), random() % shape.bricks.y(), random() % shape.bricks.z());
    if (grid.slot(b) == SparseGrid::kFar) continue;
    const Vector3i in_brick(random() % 8, random() % 8, random() % 8);
    const Vector3d c = shape.origin + shape.cell * (8 * b + in_brick).cast<double>();
    const double v = grid.cellCorners(grid.slot(b), in_brick)[0];
    const double sigma = std::uniform_real_distribution<double>(-1.0, 1.0)(random) * field.band();
    const double free = std::abs(v - sigma) - 2.0 * grid.rounding();
    const double radius2 = free * free - 0.75 * shape.cell * shape.cell;
    if (free <= 0.0 || radius2 <= 0.0) continue;
    const Vector3d q = c + std::sqrt(radius2) * (1.0 - 1e-6) * test::direction(random);
    const double at = field.sample(q).value;
    ASSERT_EQ(at > sigma, v > sigma) << q.transpose();
    least = std::min(least, std::abs(at - sigma) / shape.cell);
    ++tried;
  }
  EXPECT_LT(least, 0.1);  // the bound is nearly reached
}

TEST(DistanceField, SameForAnyNumberOfThreads) {
  const TriangleMesh mesh = test::torusMesh(0.2, 0.08, 40, 20);
  const auto bytesOf = [&](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const DistanceField field = buildField(mesh, cells(48));
    const SparseGrid& g = *FieldAccess::grid(field);
    std::vector<double> all(g.corners().data, g.corners().data + g.corners().size);
    all.insert(all.end(), g.samples().data, g.samples().data + g.samples().size);
    return all;
  };
  EXPECT_EQ(bytesOf(1), bytesOf(2));
}

TEST(DistanceField, ProgressReachesTheEnd) {
  double last = 0.0;
  bool increasing = true;
  buildField(test::boxMesh(kHalf), cells(48), [&](double share) {
    increasing = increasing && share >= last && share <= 1.0;
    last = share;
  });
  EXPECT_TRUE(increasing);
  EXPECT_GT(last, 0.9);
}

TEST(DistanceField, OpenMeshHasBoundsStill) {
  // A box without its lid: all values, errors and gradients are finite.
  TriangleMesh open = test::boxMesh(kHalf);
  open.triangles.resize(10);
  const DistanceField field = buildField(open, cells(32));
  Random random(5);
  for (int i = 0; i < 20000; ++i) {
    const FieldSample at = field.sample(test::uniformIn(random, {-2 * kHalf, 2 * kHalf}));
    ASSERT_TRUE(std::isfinite(at.value) && std::isfinite(at.error) && at.gradient.allFinite());
  }
}

TEST(DistanceField, ADefaultOneHasAnErrorOfHalfAMillimetre) {
  const TriangleMesh mesh = test::icosphere(0.05, 3);
  FieldOptions same;
  same.max_error = 5.5e-4;
  const DistanceField field = buildField(mesh, FieldOptions{}), expected = buildField(mesh, same);
  EXPECT_LE(field.errorBound(), 5.5e-4);
  EXPECT_EQ(field.errorBound(), expected.errorBound());
  EXPECT_EQ(field.cells(), expected.cells());
}

TEST(DistanceField, RefusesBadInput) {
  EXPECT_THROW(buildField(TriangleMesh{}, cells(16)), std::invalid_argument);
  TriangleMesh mesh = test::boxMesh(kHalf);
  mesh.vertices[0].x() = NAN;
  EXPECT_THROW(buildField(mesh, cells(16)), std::invalid_argument);
  mesh = test::boxMesh(kHalf);
  EXPECT_THROW(buildField(mesh, cells(0)), std::invalid_argument);
  FieldOptions both = cells(10);
  both.cell_size = 0.1;
  EXPECT_THROW(buildField(mesh, both), std::invalid_argument);
  FieldOptions tiny;
  tiny.cell_size = 1e-7;
  EXPECT_THROW(buildField(mesh, tiny), std::length_error);
  FieldOptions capped = cells(200);
  capped.max_bytes = 1 << 20;
  EXPECT_THROW(buildField(mesh, capped), std::length_error);
}

TEST(DistanceField, PrimitiveIsExact) {
  const DistanceField sphere{Primitive(Sphere{0.5})};
  EXPECT_EQ(sphere.errorBound(), 0.0);
  EXPECT_DOUBLE_EQ(sphere.sample({2, 0, 0}).value, 1.5);
  EXPECT_DOUBLE_EQ(sphere.lowerBound({0, 0, 0.1}), -0.4);
  EXPECT_EQ(FieldAccess::grid(sphere), nullptr);
  EXPECT_THROW(DistanceField(Primitive(Sphere{-1.0})), std::invalid_argument);
}

TEST(Trilinear, JensenBoundHoldsForEveryLipschitzFunction) {
  // Cones of slope one at random points: the least smooth functions that a distance can be (design §3.3).
  Random random(6);
  double worst_share = 0.0;
  for (int i = 0; i < 200000; ++i) {
    const AlignedBox3d near{Vector3d::Constant(-1), Vector3d::Constant(2)};
    std::array<Vector3d, 3> tips{test::uniformIn(random, near), test::uniformIn(random, near),
                                 test::uniformIn(random, near)};
    const auto f = [&](const Vector3d& p) {
      return std::min({(p - tips[0]).norm(), (p - tips[1]).norm(), (p - tips[2]).norm()});
    };
    std::array<double, 8> corners;
    for (int k = 0; k < 8; ++k) corners[k] = f(Vector3d(k & 1, (k >> 1) & 1, k >> 2));
    const Vector3d u = test::uniformIn(random, {Vector3d::Zero(), Vector3d::Ones()});
    const double error = std::abs(trilinear(corners, u) - f(u)), bound = lipschitzError(u, 1.0);
    ASSERT_LE(error, bound);
    worst_share = std::max(worst_share, error / bound);
  }
  EXPECT_GT(worst_share, 0.7);
}

}  // namespace sdf_ccd::distance_field_test
