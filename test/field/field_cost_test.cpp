#include "field/field_cost.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "field/spread_order.h"
#include "oracle/drawn_meshes.h"
#include "oracle/open_shapes.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "sdf_ccd/field/build_field.h"
#include "sdf_ccd/geometry/mesh_quality.h"
#include "sdf_ccd/import/mesh_file.h"

namespace sdf_ccd::field_cost_test {

FieldOptions withError(double max_error) {
  FieldOptions options;
  options.max_error = max_error;
  return options;
}

FieldOptions withCell(double cell_size) {
  FieldOptions options;
  options.cell_size = cell_size;
  return options;
}

/// Compares the estimate with the built field. If the time limit ended the sample early and two of its standard errors
/// exceed a factor of two, a factor of three is accepted.
void expectBytes(const TriangleMesh& mesh, const FieldOptions& options, double factor) {
  constexpr double kUncertain = 0.35;
  const ClosedSolid closed(std::make_shared<const Solid>(mesh));
  const FieldCost cost = expectedCost(closed, options);
  if (cost.bytes_error > kUncertain) factor = std::max(factor, 3.0);
  const auto bytes = static_cast<double>(buildField(closed, options).bytes());
  EXPECT_LT(cost.bytes, factor * bytes) << cost.bytes_error;
  EXPECT_GT(cost.bytes, bytes / factor) << cost.bytes_error;
  EXPECT_GT(cost.seconds, 0.0);
  EXPECT_GE(cost.bytes_error, 0.0);
  EXPECT_LT(cost.bytes_error, 1.0);
}

TEST(FieldCost, BytesOfAdaptiveFieldsAreExpectedWithinAFactorOfTwo) {
  const TriangleMesh plate = test::boxMesh({0.2, 0.2, 0.01});
  const TriangleMesh apart =
      merged(test::icosphere(0.05, 4), transformed(plate, Isometry3d(Eigen::Translation3d(0.5, 0, 0))));
  for (const double max_error : {0.01, 0.003, 0.001}) {
    SCOPED_TRACE(max_error);
    expectBytes(test::icosphere(0.1, 4), withError(max_error), 2.0);
    expectBytes(test::boxMesh({0.2, 0.1, 0.05}), withError(max_error), 2.0);
    expectBytes(test::binMesh(0.22), withError(max_error), 2.0);
    expectBytes(test::wheelMesh(0.1, 0.05, 40), withError(max_error), 2.0);
    expectBytes(apart, withError(max_error), 2.0);
  }
}

TEST(FieldCost, BytesOfUniformGridsAreExpectedWithinAFifth) {
  for (const double cell_size : {0.02, 0.005, 0.002}) {
    SCOPED_TRACE(cell_size);
    expectBytes(test::icosphere(0.1, 4), withCell(cell_size), 1.2);
    expectBytes(test::boxMesh({0.2, 0.1, 0.05}), withCell(cell_size), 1.2);
  }
}

TEST(FieldCost, BytesOfATeapotAreExpectedWithinAFactorOfTwo) {
  SDF_CCD_NEEDS_DATA("meshes/teapot.obj");
  const TriangleMesh mesh = orientOutward(loadMesh(test::dataPath("meshes/teapot.obj"))).mesh;
  expectBytes(mesh, withError(1e-2), 2.0);
}

TEST(FieldCost, BytesOfAnOctomapAreExpectedWithinAFifth) {
  SDF_CCD_NEEDS_DATA("octomaps/simple_2010.bt");
  double voxel = 0.0;
  const TriangleMesh mesh = loadOctomapSurface(test::dataPath("octomaps/simple_2010.bt"), voxel);
  expectBytes(mesh, withCell(0.5 * voxel), 1.2);
}

/// Where few blocks have long lists of triangles, each block is a large part of the whole work.
TEST(FieldCost, ASampleOfADenseMeshIsLittleOfTheBuild) {
  const std::string file = "robots/example-robot-data/robots/ur_description/meshes/ur5/visual/forearm.dae";
  SDF_CCD_NEEDS_DATA(file);
  const ClosedSolid closed(std::make_shared<const Solid>(orientOutward(loadMesh(test::dataPath(file))).mesh));
  const auto seconds = [](const auto& work) {
    const std::clock_t start = std::clock();
    work();
    return double(std::clock() - start) / CLOCKS_PER_SEC;
  };
  const double sample = seconds([&] { expectedCost(closed, withError(0.01)); });
  EXPECT_LT(sample, 0.15 * seconds([&] { buildField(closed, withError(0.01)); }));
}

TEST(FieldCost, DefaultOptionsHaveAResolution) {
  const ClosedSolid closed(std::make_shared<const Solid>(test::boxMesh({0.2, 0.1, 0.05})));
  const double expected = expectedCost(closed, withError(FieldOptions::kDefaultMaxError)).bytes;
  EXPECT_NEAR(expectedCost(closed, FieldOptions()).bytes, expected, 0.2 * expected);  // of samples
}

TEST(FieldCost, WhatNoFieldCanHaveIsRefused) {
  const ClosedSolid closed(std::make_shared<const Solid>(test::boxMesh({0.2, 0.1, 0.05})));
  EXPECT_THROW(expectedCost(closed, withCell(1e-7)), std::length_error);
}

TEST(SpreadOrder, MeetsEachOnceAndAnyFewInARowAreSpread) {
  for (const std::size_t count : {1u, 2u, 3u, 4u, 60u, 64u, 100u, 4096u, 5040u, 99991u}) {
    const SpreadOrder order(count);
    std::vector<int> met(count, 0);
    for (std::size_t i = 0; i < count; ++i) ++met[order[i]];
    EXPECT_EQ(std::count(met.begin(), met.end(), 1), std::ptrdiff_t(count)) << count;
    // Of 32 numbers in a row, no eighth of the range contains more than twice its share.
    for (std::size_t first = 0; count >= 64 && first + 32 <= count; first += 32) {
      std::array<int, 8> in{};
      for (std::size_t i = first; i < first + 32; ++i) ++in[8 * order[i] / count];
      EXPECT_LE(*std::max_element(in.begin(), in.end()), 8) << count << " " << first;
    }
  }
}

}  // namespace sdf_ccd::field_cost_test
