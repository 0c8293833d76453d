#include "field/adaptive/adaptive_grid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "field/field_access.h"
#include "field/trilinear_cell.h"
#include "field/uniform/sparse_grid.h"
#include "mesh/triangle_tree.h"
#include "oracle/box_union.h"
#include "oracle/failure.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::adaptive_grid_test {

using test::Random;

FieldOptions maxError(double error, double band = 0.0) {
  FieldOptions options;
  options.max_error = error;
  options.band = band;
  return options;
}

TEST(LeafScale, HoldsCornersToHalfAStep) {
  Random random(1);
  for (int i = 0; i < 20000; ++i) {
    const double h = test::uniform(random, 0.001, 1.0), band = test::uniform(random, 0.0, 5.0 * h);
    const LeafScale scale = AdaptiveGrid::leafScaleFor(h, band);
    // Distances from a plane: their differences are as large as those of any 1-Lipschitz function.
    const Vector3d normal = test::direction(random);
    const double middle = test::uniform(random, -band - 2.6 * h, band + 2.6 * h);
    std::array<double, 8> corners;
    for (int k = 0; k < 8; ++k) {
      corners[k] = middle + h * normal.dot(Vector3d(k & 1, (k >> 1) & 1, k >> 2) - Vector3d::Constant(0.5));
    }
    const std::array<double, 8> decoded = scale.decode(scale.encode(corners));
    for (int k = 0; k < 8; ++k) ASSERT_NEAR(decoded[k], corners[k], scale.rounding() * (1.0 + 1e-9));
    ASSERT_LE(scale.rounding(), 0.0072 * h + 3.2e-5 * (band + 3.5 * h));
  }
}

TEST(NodeCode, FarDistancesAreRoundedTowardsZero) {
  for (const double steps : {1.0, 1.9, -1.1, 22.99, -23.0, 500.0}) {
    const double held = node_code::steps(node_code::far(steps));
    EXPECT_EQ(std::signbit(held), std::signbit(steps));
    EXPECT_LE(std::abs(held), std::abs(steps));
    EXPECT_GT(std::abs(held) + 1.0, std::min(std::abs(steps), double(node_code::kFarSteps)));
  }
}

TEST(LeafError, IsRoundedUp) {
  const double error_bound = 0.003;
  for (double error = error_bound; error > 1e-5 * error_bound; error *= 0.97) {
    const double held = leaf_error::error(leaf_error::code(error, error_bound), error_bound);
    EXPECT_GE(held, error);
    EXPECT_TRUE(held <= 1.045 * error || held < 2e-5 * error_bound) << error;
    EXPECT_LE(held, error_bound);
  }
  EXPECT_GT(leaf_error::error(leaf_error::code(0.0, error_bound), error_bound), 0.0);
}

/// Compares a field with the exact distance at random points near the surface and all over its box.
/// @return the largest error in a leaf.
template <class Exact>
double expectHonest(const DistanceField& field, const TriangleMesh& mesh, int count, Exact exactDistance) {
  const AlignedBox3d box = field.box();
  Random random(3);
  double largest = 0.0;
  int in_band = 0;
  for (int i = 0; i < count; ++i) {
    Vector3d p = test::uniformIn(random, {box.min() - 0.1 * box.sizes(), box.max() + 0.1 * box.sizes()});
    if (i % 2 == 0) {
      const Vector3i& t = mesh.triangles[random() % mesh.triangles.size()];
      const Vector3d weights = test::uniformIn(random, {Vector3d::Zero(), Vector3d::Ones()});
      p = (weights[0] * mesh.vertices[t[0]] + weights[1] * mesh.vertices[t[1]] + weights[2] * mesh.vertices[t[2]]) /
              weights.sum() +
          test::uniform(random, 0.0, field.band()) * test::direction(random);
    }
    const double exact = exactDistance(p), distance = std::abs(exact);
    const FieldSample sample = field.sample(p);
    EXPECT_LE(std::abs(sample.value - exact), sample.error * (1.0 + 1e-9)) << p.transpose();
    EXPECT_LE(field.lowerBound(p), exact + 1e-9) << p.transpose();
    if (distance <= field.band()) {
      ++in_band;
      EXPECT_LE(sample.error, field.errorBound()) << p.transpose();
      largest = std::max(largest, std::abs(sample.value - exact));
    }
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(in_band, count / 4);
  return largest;
}

double expectHonest(const DistanceField& field, const TriangleMesh& mesh, int count) {
  const TriangleTree tree(mesh);
  return expectHonest(field, mesh, count, [&](const Vector3d& p) {
    const double distance = tree.closestPoint(p).distance;
    return tree.windingNumber(p) > 0.5 ? -distance : distance;
  });
}

/// The error bound holds, and the largest error is not far below it.
void expectBoundHolds(const TriangleMesh& mesh, double error) {
  const DistanceField field = buildField(mesh, maxError(error, 2.5 * error));
  ASSERT_NE(FieldAccess::adaptive(field), nullptr);
  EXPECT_EQ(field.errorBound(), error);
  const double largest = expectHonest(field, mesh, 20000);
  EXPECT_GT(largest, 0.2 * error);
}

TEST(AdaptiveGrid, BoundHoldsOnSphere) {
  expectBoundHolds(test::icosphere(0.3, 4), 0.0006);
}

TEST(AdaptiveGrid, BoundHoldsOnTorus) {
  expectBoundHolds(test::torusMesh(0.2, 0.08, 32, 16), 0.001);
}

TEST(AdaptiveGrid, BoundHoldsOnSharpEdges) {
  expectBoundHolds(test::boxMesh({0.2, 0.15, 0.1}), 0.001);
}

TEST(AdaptiveGrid, BoundHoldsOnPlateThinnerThanTheError) {
  expectBoundHolds(test::boxMesh({0.2, 0.15, 0.0003}), 0.002);
}

TEST(AdaptiveGrid, BoundHoldsWhereSolidsOverlap) {
  std::vector<test::OrientedBox> boxes(2);
  boxes[0].half_size = {0.2, 0.1, 0.1};
  boxes[1].half_size = {0.1, 0.05, 0.2};
  boxes[1].X_WB.translation() = Vector3d(0.05, 0.03, 0.02);
  const TriangleMesh mesh = test::meshOf(boxes);
  const DistanceField field = buildField(mesh, maxError(0.002, 0.005));
  EXPECT_EQ(field.errorBound(), 0.002);
  const auto exact = [&](const Vector3d& p) { return test::distanceToUnion(boxes, p); };
  EXPECT_GT(expectHonest(field, mesh, 20000, exact), 0.0004);
}

TEST(AdaptiveGrid, BoundHoldsInsideOut) {
  // A cavity: the solid is outside the inner sphere.
  const TriangleMesh mesh = merged(test::icosphere(0.3, 3), test::flipped(test::icosphere(0.15, 3)));
  expectBoundHolds(mesh, 0.001);
}

TEST(AdaptiveGrid, BoundHoldsOnScans) {
  SDF_CCD_NEEDS_DATA("meshes/bunny_lowres_npm.off");
  const TriangleMesh mesh = orientOutward(loadMesh(test::dataPath("meshes/bunny_lowres_npm.off"))).mesh;
  expectBoundHolds(mesh, 1e-3 * boundingBox(mesh).sizes().maxCoeff());
}

/// The error bound holds in all leaves, also where they extend beyond the band.
void expectLeavesHold(const TriangleMesh& mesh, double error) {
  const DistanceField field = buildField(mesh, maxError(error));
  const AdaptiveGrid& grid = *FieldAccess::adaptive(field);
  const AdaptiveShape& shape = grid.shape();
  const TriangleTree tree(mesh);
  Random random(11);
  int leaves = 0;
  for (int i = 0; i < 100000 && !testing::Test::HasFailure(); ++i) {
    const Vector3d p = test::uniformIn(random, shape.box());
    const AdaptiveBlock block = grid.block(((p - shape.origin) / shape.unit()).cast<int>());
    const double distance = tree.closestPoint(p).distance;
    if (!block.leaf) {
      EXPECT_GT(distance, shape.band);
      continue;
    }
    ++leaves;
    const double exact = tree.windingNumber(p) > 0.5 ? -distance : distance;
    EXPECT_NEAR(field.sample(p).value, exact, error) << p.transpose();
  }
  EXPECT_GT(leaves, 1000);
}

TEST(AdaptiveGrid, LeavesHoldTrianglesMuchSmallerThanThem) {
  expectLeavesHold(test::icosphere(0.3, 5), 0.005);
}

TEST(AdaptiveGrid, LeavesHoldSlivers) {
  expectLeavesHold(test::torusMesh(0.2, 1e-5, 7, 5), 0.002);
}

TEST(AdaptiveGrid, LeavesHoldEdges) {
  expectLeavesHold(test::boxMesh({0.2, 0.15, 0.1}), 0.002);
}

/// In leaves at random points of the surface, the error is compared with the leaf's own bound at many points.
/// @return the median of the leaves' bounds, relative to the grid's.
double expectLeavesHonest(const TriangleMesh& mesh, double error, int leaves) {
  const DistanceField field = buildField(mesh, maxError(error));
  const AdaptiveGrid& grid = *FieldAccess::adaptive(field);
  const AdaptiveShape& shape = grid.shape();
  const TriangleTree tree(mesh);
  Random random(5);
  std::vector<double> bounds;
  for (int i = 0; i < leaves && !testing::Test::HasFailure(); ++i) {
    const Vector3i& t = mesh.triangles[random() % mesh.triangles.size()];
    const Vector3d on = (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
    const AdaptiveBlock block = grid.block(((on - shape.origin) / shape.unit()).array().floor().matrix().cast<int>());
    EXPECT_TRUE(block.leaf);
    if (!block.leaf) break;
    const double bound = grid.leafError(block);
    bounds.push_back(bound);
    const std::array<double, 8> corners = grid.corners(block);
    for (int k = 0; k < 200; ++k) {
      // Every second point is on the leaf's boundary.
      Vector3d u = test::uniformIn(random, {Vector3d::Zero(), Vector3d::Ones()});
      if (k % 2 == 0) u[random() % 3] = double(random() % 2);
      const Vector3d p = shape.origin + shape.unit() * (block.low.cast<double>() + block.side * u);
      const double distance = tree.closestPoint(p).distance;
      const double exact = tree.windingNumber(p) > 0.5 ? -distance : distance;
      EXPECT_LE(std::abs(trilinear(corners, u) - exact), bound * (1.0 + 1e-9)) << p.transpose();
    }
  }
  std::nth_element(bounds.begin(), bounds.begin() + bounds.size() / 2, bounds.end());
  return bounds[bounds.size() / 2] / field.errorBound();
}

TEST(AdaptiveGrid, EveryLeafKeepsItsOwnBound) {
  EXPECT_LE(expectLeavesHonest(test::icosphere(0.3, 4), 0.0006, 300), 1.0);
  EXPECT_LT(expectLeavesHonest(test::torusMesh(0.2, 0.08, 32, 16), 0.001, 300), 1.0);
  // The middles of faces are flat: the only error is rounding.
  EXPECT_LT(expectLeavesHonest(test::boxMesh({0.2, 0.15, 0.1}), 0.001, 20), 0.3);
}

TEST(AdaptiveGrid, EveryLeafKeepsItsOwnBoundOnScansAndLinks) {
  SDF_CCD_NEEDS_DATA("meshes/bunny_lowres_npm.off");
  SDF_CCD_NEEDS_DATA("robots/pr2_description/urdf/meshes/forearm_v0/forearm.stl");
  for (const char* file :
       {"meshes/bunny_lowres_npm.off", "robots/pr2_description/urdf/meshes/forearm_v0/forearm.stl"}) {
    const TriangleMesh mesh = orientOutward(loadMesh(test::dataPath(file))).mesh;
    EXPECT_LT(expectLeavesHonest(mesh, 2e-3 * boundingBox(mesh).sizes().maxCoeff(), 300), 1.0) << file;
  }
}

TEST(AdaptiveGrid, DoesNotDependOnThreads) {
  const TriangleMesh mesh = test::torusMesh(0.2, 0.08, 32, 16);
  const DistanceField many = buildField(mesh, maxError(0.001));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const DistanceField single = buildField(mesh, maxError(0.001));
  ASSERT_EQ(many.bytes(), single.bytes());
  for (std::size_t i = 0; i < FieldAccess::adaptive(many)->arrays().leaves.size; ++i) {
    ASSERT_EQ(FieldAccess::adaptive(many)->arrays().leaves[i], FieldAccess::adaptive(single)->arrays().leaves[i]);
  }
  for (std::size_t i = 0; i < FieldAccess::adaptive(many)->leafCount(); ++i) {
    ASSERT_EQ(FieldAccess::adaptive(many)->arrays().leaf_errors[i],
              FieldAccess::adaptive(single)->arrays().leaf_errors[i]);
  }
}

TEST(AdaptiveGrid, FlatSurfaceCostsLittle) {
  // As fine as a grid of 250 cells along the side, but only along the edges.
  const DistanceField box = buildField(test::boxMesh({0.2, 0.2, 0.2}), maxError(0.0016));
  FieldOptions uniform;
  uniform.cell_size = 0.0016 * 2.0 / std::sqrt(3.0);
  EXPECT_LT(10 * box.bytes(), buildField(test::boxMesh({0.2, 0.2, 0.2}), uniform).bytes());
}

TEST(AdaptiveGrid, MemoryLimitIsKept) {
  FieldOptions options = maxError(0.0001);
  options.max_bytes = 100000;
  EXPECT_THROW(buildField(test::torusMesh(0.2, 0.08, 32, 16), options), std::length_error);
}

TEST(AdaptiveGrid, BeyondTheLimitAnErrorThatFitsIsNamed) {
  const TriangleMesh torus = test::torusMesh(0.2, 0.08, 128, 64);
  for (const double max_error : {1e-5, 1e-4}) {
    FieldOptions options = maxError(max_error);
    options.max_bytes = buildField(torus, options).bytes() / 3;
    const std::string refusal = test::failureOf<std::length_error>([&] { buildField(torus, options); });
    const std::size_t named = refusal.find("; about ");
    ASSERT_NE(named, std::string::npos) << refusal;
    options.max_error = std::stod(refusal.substr(named + 8));
    EXPECT_GT(*options.max_error, max_error) << refusal;
    EXPECT_LT(*options.max_error, 20.0 * max_error) << refusal;
    EXPECT_NO_THROW(buildField(torus, options)) << refusal;
  }
}

TEST(AdaptiveGrid, FitsALimitOfItsOwnSize) {
  TriangleMesh star = test::icosphere(0.1, 2);
  for (std::size_t i = 0; i < star.vertices.size(); i += 3) star.vertices[i] *= 4.0;
  for (const TriangleMesh& mesh : {star, test::torusMesh(0.2, 0.08, 32, 16)}) {
    FieldOptions options = maxError(0.001);
    options.max_bytes = buildField(mesh, options).bytes();
    EXPECT_EQ(buildField(mesh, options).bytes(), options.max_bytes);
    --options.max_bytes;
    EXPECT_THROW(buildField(mesh, options), std::length_error);
  }
}

TEST(AdaptiveGrid, ALeafFillsAnOctant) {
  AdaptiveShape shape;
  shape.cell = 1.0;
  shape.size = {1, 1, 1};
  shape.surface_box = shape.box();
  shape.error_bound = 0.01;
  AdaptiveData data;
  data.top = {0 << 2 | top_word::kNode};
  data.bases = {{0, 0, 0}};
  data.nodes.resize(1);
  std::array<std::uint8_t, 64>& codes = data.nodes[0].codes;
  codes.fill(node_code::far(-3.0));
  codes[63] = node_code::kLeaf + 1;
  for (const int child : {2, 3, 6, 7, 18, 19, 22, 23}) codes[child] = node_code::kWide;  // the octant at upper x
  const LeafScale wide = AdaptiveGrid::leafScaleFor(0.5, shape.band), small = AdaptiveGrid::leafScaleFor(0.25, 0.0);
  data.leaves = {wide.encode({0.0, 0.1, 0.2, 0.3, 0.4, 0.1, 0.2, 0.3}), small.encode({0, 0, 0, 0, 0, 0, 0, 0})};
  data.leaf_errors = {0, 0};
  const AdaptiveGrid grid(shape, data);
  for (const Vector3i& unit : {Vector3i(64, 0, 0), Vector3i(127, 63, 63), Vector3i(100, 40, 20)}) {
    const AdaptiveBlock block = grid.block(unit);
    EXPECT_TRUE(block.leaf);
    EXPECT_EQ(block.low, Vector3i(64, 0, 0));
    EXPECT_EQ(block.side, 64);
    EXPECT_EQ(block.index, 0u);
    EXPECT_NEAR(grid.corners(block)[4], 0.4, wide.rounding());
  }
  EXPECT_EQ(grid.block({127, 127, 127}).index, 1u);
  EXPECT_FALSE(grid.block({63, 0, 0}).leaf);

  for (const int child : {2, 22}) {
    AdaptiveData torn = data;
    torn.nodes[0].codes[child] = node_code::far(1.0);
    EXPECT_THROW(AdaptiveGrid(shape, torn), std::invalid_argument) << child;
  }
  AdaptiveData missing = data;
  for (const int child : {2, 3, 6, 7, 18, 19, 22, 23}) missing.nodes[0].codes[child] = node_code::kWide + 2;
  EXPECT_THROW(AdaptiveGrid(shape, missing), std::invalid_argument);
}

TEST(AdaptiveGrid, DamagedIndicesAreRefused) {
  const AdaptiveShape shape = [] {
    AdaptiveShape s;
    s.cell = 1.0;
    s.size = {1, 1, 2};
    s.surface_box = s.box();
    return s;
  }();
  AdaptiveData far;
  far.top = {EmptySphere{{}, 7, false}.word(), EmptySphere{{1, 0, -2}, 900, true}.word()};
  const AdaptiveBlock block = AdaptiveGrid(shape, far).block({5, 6, 200});
  EXPECT_TRUE(block.inside);
  EXPECT_NEAR(block.ball_radius, 900 * EmptySphere::step(shape.size), 1e-12);
  EXPECT_EQ(block.ball_center, Vector3d(192.0, 64.0, -64.0));
  AdaptiveData lost = far;
  lost.top[1] = 7 << 2 | top_word::kLeaf;
  EXPECT_THROW(AdaptiveGrid(shape, lost), std::invalid_argument);
  AdaptiveData unbounded = far;
  unbounded.leaves.resize(1);
  EXPECT_THROW(AdaptiveGrid(shape, unbounded), std::invalid_argument);
  AdaptiveData twice = far;
  twice.top = {0 << 2 | top_word::kNode, 0 << 2 | top_word::kNode};
  twice.nodes.resize(1);
  twice.nodes[0].codes.fill(node_code::far(3));
  twice.bases.resize(1);
  EXPECT_THROW(AdaptiveGrid(shape, twice), std::invalid_argument);
  AdaptiveData loop = far;
  loop.top[0] = 0 << 2 | top_word::kNode;
  loop.nodes.resize(1);
  loop.nodes[0].codes.fill(node_code::kNode);
  loop.bases = {{0, 0, 0}};
  EXPECT_THROW(AdaptiveGrid(shape, loop), std::invalid_argument);
}

}  // namespace sdf_ccd::adaptive_grid_test
