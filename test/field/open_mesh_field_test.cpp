#include <gtest/gtest.h>

#include "field/field_access.h"
#include "oracle/drawn_meshes.h"
#include "oracle/open_shapes.h"
#include "oracle/parameter_name.h"
#include "oracle/random.h"
#include "oracle/test_data.h"
#include "oracle/winding_number.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"
#include "solid/openings/openings.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd::open_mesh_field_test {

using test::distance;
using test::Random;

constexpr double kHalf = 0.22;  // half of the bin's side [m]

std::vector<FieldOptions> bothKinds(double max_error, int cells) {
  FieldOptions adaptive, uniform;
  adaptive.max_error = max_error;
  uniform.cells = cells;
  return {adaptive, uniform};
}

double boxDistance(const Vector3d& p) {
  return signedDistance(Box::fromSize(Vector3d::Constant(2.0 * kHalf)), p);
}

/// With the sign of the winding number alone, which jumps where that is one half, it had 652,022 leaves at 8 mm.
TEST(OpenMeshField, TheOpenBinNeedsAsManyLeavesAsTheClosedOne) {
  FieldOptions options;
  options.max_error = 0.008;
  const DistanceField closed = buildField(test::boxMesh(Vector3d::Constant(kHalf)), options);
  const DistanceField open = buildField(test::binMesh(kHalf), options);
  EXPECT_LE(open.cells(), 1.1 * closed.cells());
  EXPECT_LE(open.errorBound(), 0.008);
  EXPECT_FALSE(FieldAccess::openings(closed));
  ASSERT_TRUE(FieldAccess::openings(open));
}

/// The field is that of the bin with its lid, which is a box.
TEST(OpenMeshField, IsThatOfTheClosedSolid) {
  Random random(1);
  for (const FieldOptions& options : bothKinds(0.008, 32)) {
    const DistanceField field = buildField(test::binMesh(kHalf), options);
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-0.3), Vector3d::Constant(0.3)});
      const FieldSample sample = field.sample(p);
      ASSERT_LE(std::abs(sample.value - boxDistance(p)), sample.error + 1e-9) << p.transpose();
      ASSERT_LE(field.bounds(p).low, boxDistance(p) + 1e-9);
      ASSERT_GE(field.bounds(p).high, boxDistance(p) - 1e-9);
    }
  }
}

TEST(OpenMeshField, KnowsItsOpening) {
  for (const FieldOptions& options : bothKinds(0.008, 32)) {
    const DistanceField field = buildField(test::binMesh(kHalf), options);
    EXPECT_NEAR(field.openingDistance({0, 0, 0}), kHalf, 1e-12);
    EXPECT_NEAR(field.openingDistance({0.1, 0.1, 0.3}), 0.08, 1e-12);
    EXPECT_NEAR(field.openingDistance({0.1, 0.1, -0.3}), 0.52, 1e-12);
    const DistanceField closed = buildField(test::boxMesh(Vector3d::Constant(kHalf)), options);
    EXPECT_EQ(closed.openingDistance({0, 0, 0}), kInfinity);
  }
}

/// Samples of the mesh alone bound the distance to its triangles; inside, with either sign.
TEST(OpenMeshField, MeshSampleHoldsOfTheTriangles) {
  Random random(2);
  const TriangleMesh bin = test::binMesh(kHalf);
  for (const FieldOptions& options : bothKinds(0.008, 32)) {
    const DistanceField field = buildField(bin, options);
    int exact = 0;
    for (int i = 0; i < 20000; ++i) {
      const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-0.3), Vector3d::Constant(0.3)});
      const double truth = distance(bin, p);
      const FieldSample sample = field.meshSample(p);
      ASSERT_LE(std::abs(sample.value - truth), sample.error + 1e-9) << p.transpose();
      ASSERT_TRUE(sample.value >= 0.0 || std::abs(sample.value + truth) <= sample.error + 1e-9) << p.transpose();
      exact += sample.error == field.sample(p).error;
    }
    // Beside and below the bin the error is that of the field.
    EXPECT_GT(exact, 5000);
    EXPECT_EQ(field.meshSample({0, 0, -0.25}).error, field.sample({0, 0, -0.25}).error);
    EXPECT_GT(field.meshSample({0, 0, 0.25}).error, 0.2);
  }
}

/// A box with a square hole in its top. However narrow the hole, distances beside it are not taken as those of a closed
/// box, although those are nearly exact where the surface is flat.
TEST(OpenMeshField, SamplesHoldBesideHolesNarrowerThanTheError) {
  Random random(6);
  for (const double hole : {0.002, 0.012}) {
    TriangleMesh mesh = test::binMesh(kHalf);
    const int first = static_cast<int>(mesh.vertices.size());
    for (const double half : {hole, kHalf})
      for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
        mesh.vertices.emplace_back(half * x, half * y, kHalf);
    for (int k = 0; k < 4; ++k) {
      const int next = (k + 1) % 4;
      mesh.triangles.emplace_back(first + 4 + k, first + 4 + next, first + next);
      mesh.triangles.emplace_back(first + 4 + k, first + next, first + k);
    }
    for (const FieldOptions& options : bothKinds(0.02, 20)) {
      const DistanceField field = buildField(mesh, options);
      EXPECT_EQ(field.hasOpenings(), hole > 0.01);
      EXPECT_EQ(field.moved() >= hole, hole < 0.01);
      EXPECT_LE(field.errorBound(), 0.022);
      const Vector3d middle(0, 0, kHalf), reach(2 * hole, 2 * hole, 4 * hole);
      for (int i = 0; i < 5000; ++i) {
        const Vector3d p = test::uniformIn(random, {middle - reach, middle + reach});
        const double truth = distance(mesh, p);
        const FieldSample sample = field.meshSample(p);
        ASSERT_LE(std::abs(std::abs(sample.value) - truth), sample.error + 1e-9) << p.transpose();
        ASSERT_LE(field.lowerBound(p), truth + 1e-9) << p.transpose();
      }
    }
  }
}

/// Faces whose vertices differ by the rounding of floats are joined; the bounds include by how much.
TEST(OpenMeshField, BoundsIncludeHowFarVerticesWereMoved) {
  Random random(7);
  TriangleMesh soup;
  const TriangleMesh ball = test::icosphere(0.3, 1);
  for (const Vector3i& t : ball.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(ball.vertices[t[k]] + 1e-8 * test::direction(random));
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  for (const FieldOptions& options : bothKinds(0.01, 32)) {
    const DistanceField field = buildField(soup, options);
    EXPECT_GT(field.moved(), 1e-8);
    EXPECT_LT(field.moved(), 1e-6);
    EXPECT_GE(field.sample({0, 0, 0.3}).error, field.moved());
    EXPECT_EQ(buildField(ball, options).moved(), 0.0);
  }
}

/// A mesh whose triangles nearly meet counts as closed. (Closest points on slivers are less exact: with a tolerance of
/// 1e-12 for ties, one sample had the wrong sign, and five times as many leaves were needed.)
TEST(OpenMeshField, CracksAreNoOpenings) {
  Random random(3);
  TriangleMesh soup;
  const TriangleMesh ball = test::icosphere(0.3, 1);
  for (const Vector3i& t : ball.triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int k = 0; k < 3; ++k) soup.vertices.push_back(ball.vertices[t[k]] + 2e-5 * test::direction(random));
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  for (const FieldOptions& options : bothKinds(0.01, 32)) {
    const DistanceField field = buildField(soup, options), closed = buildField(ball, options);
    EXPECT_FALSE(FieldAccess::openings(field));
    EXPECT_LE(field.cells(), 2.0 * closed.cells());  // triangles that overlap by the jitter are clipped to slivers
    for (int i = 0; i < 2000; ++i) {
      const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-0.4), Vector3d::Constant(0.4)});
      const FieldSample a = field.sample(p), b = closed.sample(p);
      ASSERT_LE(std::abs(a.value - b.value), a.error + b.error + 2e-5);  // the jitter
    }
  }
}

/// Faces inside the other box are no surface, although the boxes are closed only geometrically, without shared edges.
TEST(OpenMeshField, BoxesOfDividedFacesHaveTheDepthOfTheirUnion) {
  const Vector3d half(0.3, 0.2, 0.2), offset(0.25, 0.05, 0.03);
  const TriangleMesh drawn =
      merged(test::boxOfDividedFaces(half), test::translated(test::boxOfDividedFaces(half), offset));
  const AlignedBox3d first(-half, half), second(offset - half, offset + half);
  const auto depthIn = [](const AlignedBox3d& box, const Vector3d& p) {
    return std::min((p - box.min()).minCoeff(), (box.max() - p).minCoeff());
  };
  Random random(5);
  for (const FieldOptions& options : bothKinds(0.005, 64)) {
    const DistanceField field = buildField(orientOutward(drawn).mesh, options);
    EXPECT_FALSE(FieldAccess::openings(field));
    for (int i = 0; i < 2000; ++i) {
      const Vector3d p = test::uniformIn(random, first.merged(second));
      const double depth = std::max(depthIn(first, p), depthIn(second, p));  // if positive, a lower bound
      const FieldSample sample = field.sample(p);
      if (depth > 0.0) {
        ASSERT_LE(sample.value - sample.error, -depth + 1e-9);
      }
      if (depth < -sample.error) {
        ASSERT_GE(sample.value + sample.error, 0.0);
      }
    }
  }
}

class RealOpenMesh : public testing::TestWithParam<const char*> {};

/// No sample's error exceeds its bound. The true distance and side come from sums over all triangles of mesh and caps.
TEST_P(RealOpenMesh, SamplesHold) {
  SDF_CCD_NEEDS_DATA(GetParam());
  const TriangleMesh mesh = orientOutward(loadMesh(test::dataPath(GetParam()))).mesh;
  const Openings openings = findOpenings(mesh);
  const TriangleMesh closed = welded(merged(mesh, openings.caps));
  const double size = boundingBox(mesh).sizes().maxCoeff();
  // Where parts overlap, the depth is that in their union: at least the distance to the nearest triangle.
  const SolidReport overlaps = Solid(closed).report();
  const bool overlapping = overlaps.dropped + overlaps.clipped > 0;
  Random random(4);
  for (const FieldOptions& options : bothKinds(0.004 * size, 64)) {
    const DistanceField field = buildField(mesh, options);
    for (int i = 0; i < 300; ++i) {
      const Vector3d p = test::uniformIn(random, boundingBox(mesh));
      const double winding = test::windingNumber(closed, p);
      const double truth = (std::abs(winding) > 0.5 ? -1.0 : 1.0) * distance(closed, p);
      const FieldSample sample = field.sample(p);
      ASSERT_LE(sample.value - truth, sample.error + 1e-6 * size) << p.transpose();
      if (overlapping && std::abs(winding) > 0.5) continue;
      ASSERT_LE(std::abs(sample.value - truth), sample.error + 1e-6 * size) << p.transpose();
      ASSERT_GE(distance(mesh, p), std::abs(sample.value) - sample.error - 1e-6 * size);
      const FieldSample of_mesh = field.meshSample(p);
      const double to_mesh = FieldAccess::openings(field) ? distance(mesh, p) : truth;
      ASSERT_LE(std::abs(of_mesh.value - to_mesh), of_mesh.error + 1e-6 * size);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, RealOpenMesh,
                         testing::Values("meshes/teapot.obj", "meshes/bunny_lowres_npm.off",
                                         "robots/pr2_description/urdf/meshes/shoulder_v0/shoulder_lift.stl",
                                         "robots/pr2_description/urdf/meshes/torso_v0/torso_lift.stl",
                                         "robots/pr2_description/urdf/meshes/gripper_v0/l_finger.stl"),
                         test::ParameterName());

}  // namespace sdf_ccd::open_mesh_field_test
