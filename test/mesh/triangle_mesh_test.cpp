#include "sdf_ccd/mesh.h"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "oracle/failure.h"
#include "oracle/shapes.h"

namespace sdf_ccd::triangle_mesh_test {

TEST(TriangleMesh, ClosedFormsOfABox) {
  const TriangleMesh box = test::translated(test::boxMesh({1, 2, 3}), {100, -200, 300});
  EXPECT_NEAR(surfaceArea(box), 8 * (1 * 2 + 2 * 3 + 3 * 1), 1e-9);
  EXPECT_NEAR(signedVolume(box), 48, 1e-9);
  EXPECT_NEAR(signedVolume(test::flipped(box)), -48, 1e-9);
  EXPECT_TRUE(boundingBox(box).min().isApprox(Vector3d(99, -202, 297)));
}

TEST(TriangleMesh, AMirroringScaleKeepsTheOutsideOutside) {
  const TriangleMesh box = test::boxMesh({1, 2, 3});
  for (const Vector3d& scale : {Vector3d(1, -1, 1), Vector3d(-2, -3, 0.5), Vector3d(-1, -1, -1)}) {
    EXPECT_NEAR(signedVolume(scaled(box, scale)), 48 * std::abs(scale.prod()), 1e-9) << scale.transpose();
  }
  EXPECT_THROW(scaled(box, {1, 0, 1}), std::invalid_argument);
  EXPECT_THROW(scaled(box, {1, std::numeric_limits<double>::quiet_NaN(), 1}), std::invalid_argument);
}

TEST(TriangleMesh, MovingKeepsVolumeAndMovesTheBox) {
  const Isometry3d X = Eigen::Translation3d(1, 2, 3) * Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized());
  const TriangleMesh moved = transformed(test::icosphere(0.5, 3), X);
  EXPECT_NEAR(signedVolume(moved), signedVolume(test::icosphere(0.5, 3)), 1e-12);
  EXPECT_TRUE(boundingBox(moved).center().isApprox(Vector3d(1, 2, 3), 1e-2));
}

TEST(TriangleMesh, WeldingMakesTwinsOneAndDropsWhatHasNoArea) {
  TriangleMesh soup;
  for (const Vector3i& t : test::boxMesh({1, 1, 1}).triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int i = 0; i < 3; ++i) soup.vertices.push_back(test::boxMesh({1, 1, 1}).vertices[t[i]]);
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  soup.triangles.emplace_back(0, 0, 1);
  soup.vertices.emplace_back(7, 7, 7);
  const TriangleMesh mesh = welded(soup);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_NEAR(signedVolume(mesh), 8, 1e-12);
}

TEST(TriangleMesh, ZeroAndMinusZeroWeld) {
  TriangleMesh soup;
  soup.vertices = {{0.0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, 0, -0.0}, {0, 1, 0}, {-1, 0, 0}};
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(welded(soup).vertices.size(), 4u);
}

TEST(TriangleMesh, MergingShiftsIndices) {
  const TriangleMesh both = merged(test::boxMesh({1, 1, 1}), test::translated(test::boxMesh({1, 1, 1}), {5, 0, 0}));
  EXPECT_EQ(both.triangles.size(), 24u);
  EXPECT_NEAR(signedVolume(both), 16, 1e-12);
  EXPECT_NO_THROW(validate(both));
}

TEST(TriangleMesh, ValidateNamesWhatIsWrong) {
  const auto message = [](const TriangleMesh& mesh) {
    return test::failureOf<std::invalid_argument>([&] { validate(mesh); });
  };
  EXPECT_EQ(message(test::boxMesh({1, 1, 1})), "");
  EXPECT_EQ(message({}), "the mesh has no triangle");
  TriangleMesh mesh = test::boxMesh({1, 1, 1});
  mesh.triangles[3][1] = 8;
  EXPECT_EQ(message(mesh), "triangle 3 refers to vertex 8, but there are only 8 vertices (from 0)");
  mesh.triangles[3][1] = -1;
  EXPECT_EQ(message(mesh), "triangle 3 refers to vertex -1, but there are only 8 vertices (from 0)");
  mesh = test::boxMesh({1, 1, 1});
  mesh.vertices[5].y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(message(mesh).find("vertex 5 is not finite"), std::string::npos);
  EXPECT_NE(message(test::boxMesh({1e6, 1, 1})).find("too large"), std::string::npos);
  EXPECT_NE(message(test::boxMesh({1e-10, 1e-10, 1e-10})).find("smaller than 1e-9 m"), std::string::npos);
}

}  // namespace sdf_ccd::triangle_mesh_test
