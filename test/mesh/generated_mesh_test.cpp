#include "mesh/generated_mesh.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sdf_ccd/mesh.h"

namespace sdf_ccd::generated_mesh_test {

constexpr double kPi = 3.14159265358979323846;
constexpr Thread kThread{0.02, 0.008, 0.004};

TEST(GeneratedMesh, AllAreClosedAndEncloseVolume) {
  const std::pair<const char*, TriangleMesh> meshes[] = {
      {"bowl", bowlMesh(0.1, 0.01, 48)},          {"blob", blobMesh(0.1, 0.2, 800)},
      {"top", topMesh(0.04, 0.08, 32)},           {"wedge", wedgeMesh(0.1, 0.2, 0.3)},
      {"slot", slotMesh(0.1, 0.2, 0.3)},          {"bolt", boltMesh(kThread, 0.08, 48)},
      {"nut", nutMesh(kThread, 0.001, 0.02, 48)}, {"cone", coneMesh(0.1, 0.3)}};
  for (const auto& [name, mesh] : meshes) {
    const MeshQuality quality = orientOutward(mesh).quality;
    EXPECT_TRUE(quality.sign_trusted) << name << ": " << summary(quality);
    EXPECT_EQ(quality.inverted_components, 0) << name;
    EXPECT_EQ(quality.boundary_edges + quality.non_manifold_edges + quality.misoriented_edges, 0) << name;
    EXPECT_GT(signedVolume(mesh), 0.0) << name;
  }
}

TEST(GeneratedMesh, VolumesHaveTheirClosedForms) {
  EXPECT_NEAR(signedVolume(wedgeMesh(0.1, 0.2, 0.3)), 0.5 * 0.1 * 0.2 * 0.3, 1e-12);
  EXPECT_NEAR(signedVolume(slotMesh(0.1, 0.2, 0.3)), 0.2 * 0.3 * 0.3 - 0.5 * 0.1 * 0.2 * 0.3, 1e-12);
  const double R = 0.1, t = 0.02, rim = kPi * kPi * t * t / 4.0 * (R - 0.5 * t);  // half a torus (Pappus)
  const double bowl = 2.0 / 3.0 * kPi * (R * R * R - std::pow(R - t, 3)) + rim;
  EXPECT_NEAR(signedVolume(bowlMesh(R, t, 400)), bowl, 0.01 * bowl);
}

TEST(GeneratedMesh, AConeIsContainedAndHardlyExceeded) {
  const double radius = 0.1, height = 0.3;
  const TriangleMesh mesh = coneMesh(radius, height);
  const Vector3d tip(0, 0, 0.5 * height);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    // The plane of each side touches the cone, or contains its base.
    const Vector3d n = areaNormal(mesh, static_cast<int>(i)).normalized();
    const double offset = n.dot(mesh.vertices[mesh.triangles[i][0]]);
    const double farthest = std::max(n.dot(tip), radius * n.head<2>().norm() - 0.5 * height * n.z());
    EXPECT_GE(offset, farthest - 1e-12);
    EXPECT_LE(offset, farthest + 1e-12);
  }
  for (const Vector3d& p : mesh.vertices) EXPECT_LE(p.head<2>().norm(), (1.0 + kConeExcess) * radius);
}

TEST(GeneratedMesh, BlobHasThePointsAskedFor) {
  for (const int points : {777, 2072, 437645}) {
    EXPECT_NEAR(double(blobMesh(0.1, 0.2, points).vertices.size()), points, 0.05 * points);
  }
}

TEST(GeneratedMesh, ImpossibleSizesAreRefused) {
  EXPECT_THROW(bowlMesh(0.1, 0.1, 48), std::invalid_argument);
  EXPECT_THROW(bowlMesh(0.1, 0.01, 2), std::invalid_argument);
  EXPECT_THROW(blobMesh(0.0, 0.1, 100), std::invalid_argument);
  EXPECT_THROW(wedgeMesh(0.1, std::nan(""), 1.0), std::invalid_argument);
  EXPECT_THROW(boltMesh({0.02, 0.008, 0.03}, 0.1, 32), std::invalid_argument);
  EXPECT_THROW(extruded({{0, 0, 0}, {1, 0, 0}}, 1.0), std::invalid_argument);
}

}  // namespace sdf_ccd::generated_mesh_test
