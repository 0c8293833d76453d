// Fields of meshes as people draw them, made by orientOutward() and buildField().
#include <gtest/gtest.h>

#include "oracle/drawn_meshes.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::drawn_mesh_test {

DistanceField fieldOf(const TriangleMesh& mesh, double cell) {
  FieldOptions options;
  options.cell_size = cell;
  return buildField(orientOutward(mesh).mesh, options);
}

TEST(DrawnMesh, AWheelsWebIsThere) {
  const TriangleMesh wheel = test::wheelMesh(0.3, 0.1, 48);
  const DistanceField field = fieldOf(wheel, 0.005);
  for (const double x : {0.01, 0.1, 0.2, 0.25}) {
    const FieldSample sample = field.sample({x, 0.003, 0.0});
    EXPECT_LE(std::abs(sample.value), sample.error + 1e-6) << x;
  }
}

TEST(DrawnMesh, AShelfInsideOutInAnOpenCupboardIsSolid) {
  const test::Cupboard cupboard;
  ASSERT_EQ(cupboard.shelf.triangles.size() + cupboard.walls.triangles.size(), 46u);
  for (const TriangleMesh& shelf : {cupboard.shelf, test::flipped(cupboard.shelf)}) {
    for (const TriangleMesh& walls : {cupboard.walls, test::flipped(cupboard.walls)}) {
      const DistanceField field = fieldOf(merged(walls, shelf), 0.02);
      for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(0.4, -0.4, 0.01), Vector3d(-0.3, 0.5, -0.01)}) {
        EXPECT_LT(field.sample(p).value, 0.0) << p.transpose();
      }
      for (const double z : {-0.5, 0.5, 0.1}) EXPECT_GT(field.sample({0, 0.3, z}).value, 0.0) << z;
      EXPECT_GT(field.sample({0, 0, 2}).value, 0.0);
    }
  }
}

TEST(DrawnMesh, BothLobesOfABowTieAreSolid) {
  const TriangleMesh mesh = test::bowTieMesh();
  for (const TriangleMesh& drawn : {mesh, test::flipped(mesh)}) {
    const DistanceField field = fieldOf(drawn, 0.005);
    const FieldSample lobe = field.sample({0.125, 0, 0}), rod = field.sample({0, 0, 0.1});
    EXPECT_NEAR(lobe.value, -0.025, lobe.error + 1e-4);
    EXPECT_NEAR(rod.value, -0.05, rod.error + 1e-4);
    EXPECT_GT(field.sample({0.075, 0, 0}).value, 0.0);
  }
}

TEST(DrawnMesh, ACavityStaysACavity) {
  const TriangleMesh hollow = merged(test::boxMesh({0.1, 0.1, 0.1}), test::flipped(test::icosphere(0.05, 3)));
  for (const TriangleMesh& drawn : {hollow, test::flipped(hollow)}) {
    const DistanceField field = fieldOf(drawn, 0.01);
    EXPECT_NEAR(field.sample({0, 0, 0}).value, 0.05, 0.012);
    EXPECT_NEAR(field.sample({0.075, 0, 0}).value, -0.025, 0.012);
    EXPECT_GT(field.sample({0.15, 0, 0}).value, 0.0);
  }
}

}  // namespace sdf_ccd::drawn_mesh_test
