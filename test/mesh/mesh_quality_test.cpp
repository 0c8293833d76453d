#include "sdf_ccd/mesh.h"

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "mesh/triangle_tree.h"
#include "oracle/shapes.h"

namespace sdf_ccd::mesh_quality_test {

using test::boxMesh;
using test::flipped;
using test::icosphere;
using test::translated;

TEST(MeshQuality, AClosedMeshIsLeftAlone) {
  const TriangleMesh box = boxMesh({1, 2, 3});
  const OrientedMesh result = orientOutward(box);
  EXPECT_EQ(result.mesh.triangles.size(), 12u);
  EXPECT_EQ(result.quality.triangles, 12);
  EXPECT_EQ(result.quality.components, 1);
  EXPECT_EQ(result.quality.boundary_edges, 0);
  EXPECT_EQ(result.quality.non_manifold_edges, 0);
  EXPECT_EQ(result.quality.misoriented_edges, 0);
  EXPECT_EQ(result.quality.inverted_components, 0);
  EXPECT_NEAR(result.quality.volume, 48, 1e-9);
  EXPECT_NEAR(result.quality.area, 88, 1e-9);
  EXPECT_TRUE(result.quality.sign_trusted);
  EXPECT_EQ(summary(result.quality), "12 triangles, closed, volume 48 m^3, sign trusted");
}

TEST(MeshQuality, InsideOutIsTurnedRound) {
  const OrientedMesh result = orientOutward(flipped(icosphere(1, 2)));
  EXPECT_EQ(result.quality.inverted_components, 1);
  EXPECT_GT(result.quality.volume, 3.9);
  EXPECT_TRUE(result.quality.sign_trusted);
}

TEST(MeshQuality, TrianglesTurnedAtRandomAreMadeToAgree) {
  TriangleMesh mesh = icosphere(1, 3);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
  const OrientedMesh result = orientOutward(mesh);
  EXPECT_GT(result.quality.misoriented_edges, 100);
  EXPECT_NEAR(result.quality.volume, signedVolume(icosphere(1, 3)), 1e-12);
  EXPECT_TRUE(result.quality.sign_trusted);
}

TEST(MeshQuality, EveryComponentIsTurnedForItself) {
  const TriangleMesh mesh = merged(flipped(boxMesh({1, 1, 1})), translated(boxMesh({1, 1, 1}), {5, 0, 0}));
  const OrientedMesh result = orientOutward(mesh);
  EXPECT_EQ(result.quality.components, 2);
  EXPECT_EQ(result.quality.inverted_components, 1);
  EXPECT_NEAR(result.quality.volume, 16, 1e-9);
  EXPECT_FALSE(result.quality.sign_trusted);
}

TEST(MeshQuality, CavitiesStay) {
  const TriangleMesh hollow = merged(boxMesh({1, 1, 1}), flipped(icosphere(0.5, 2)));
  const OrientedMesh result = orientOutward(hollow);
  EXPECT_EQ(result.quality.inverted_components, 0);
  EXPECT_LT(result.quality.volume, 8 - 0.4);
  const TriangleTree tree(result.mesh);
  EXPECT_NEAR(tree.windingNumber({0, 0, 0}), 0, 0.02);
  EXPECT_NEAR(tree.windingNumber({0.8, 0.8, 0.8}), 1, 0.02);
}

TEST(MeshQuality, AnInvertedPartThatSticksOutIsNoCavity) {
  const TriangleMesh mesh = merged(boxMesh({1, 1, 1}), flipped(translated(boxMesh({0.2, 0.2, 0.2}), {1, 0, 0})));
  const OrientedMesh result = orientOutward(mesh);
  EXPECT_EQ(result.quality.inverted_components, 1);
  EXPECT_NEAR(TriangleTree(result.mesh).windingNumber({1.1, 0, 0}), 1, 0.05);
  EXPECT_FALSE(result.quality.sign_trusted);
}

TEST(MeshQuality, DuplicatesAreDropped) {
  const TriangleMesh box = boxMesh({1, 1, 1});
  for (const TriangleMesh& twin : {box, flipped(box)}) {
    const OrientedMesh result = orientOutward(merged(box, twin));
    EXPECT_EQ(result.quality.triangles, 12);
    EXPECT_NEAR(result.quality.volume, 8, 1e-9);
    EXPECT_TRUE(result.quality.sign_trusted);
  }
}

TEST(MeshQuality, AWallBetweenGluedSolidsGoes) {
  const OrientedMesh result = orientOutward(merged(boxMesh({1, 1, 1}), translated(boxMesh({1, 1, 1}), {2, 0, 0})));
  EXPECT_EQ(result.quality.triangles, 20);
  EXPECT_NEAR(result.quality.volume, 16, 1e-9);
  EXPECT_TRUE(result.quality.sign_trusted);
  EXPECT_NEAR(TriangleTree(result.mesh).windingNumber({1, 0.1, 0.2}), 1, 0.05);
}

TEST(MeshQuality, AFinDrawnFromBothSidesStays) {
  TriangleMesh mesh = boxMesh({1, 1, 1});
  mesh.vertices.emplace_back(2, 0, 1);
  mesh.triangles.emplace_back(5, 7, 8);
  mesh.triangles.emplace_back(7, 5, 8);
  const OrientedMesh result = orientOutward(mesh);
  EXPECT_EQ(result.quality.triangles, 13);
  EXPECT_EQ(result.quality.non_manifold_edges, 1);
  EXPECT_FALSE(result.quality.sign_trusted);
}

TEST(MeshQuality, OpenMeshesAreNotTrustedAndAClearSkinIsTurned) {
  TriangleMesh open = icosphere(1, 3);
  open.triangles.resize(open.triangles.size() - 3);
  for (const TriangleMesh& mesh : {open, flipped(open)}) {
    const OrientedMesh result = orientOutward(mesh);
    EXPECT_GT(result.quality.boundary_edges, 0);
    EXPECT_FALSE(result.quality.sign_trusted);
    EXPECT_GT(result.quality.volume, 3.5);
    EXPECT_EQ(result.quality.inverted_components, 0);
  }
}

TEST(MeshQuality, TheWallOfAHoleIsNotTakenForAnInvertedSkin) {
  // A tube whose inner and outer walls do not meet: two open patches, the inner one rightly facing the axis.
  TriangleMesh tube;
  constexpr int n = 24;
  for (const double radius : {1.0, 0.5}) {
    const int first = static_cast<int>(tube.vertices.size());
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * test::kPi * i / n;
      tube.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), -1);
      tube.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 1);
    }
    for (int i = 0; i < n; ++i) {
      const int a = first + 2 * i, b = first + 2 * ((i + 1) % n);
      tube.triangles.push_back(radius == 1.0 ? Vector3i(a, b, b + 1) : Vector3i(a, b + 1, b));
      tube.triangles.push_back(radius == 1.0 ? Vector3i(a, b + 1, a + 1) : Vector3i(a, a + 1, b + 1));
    }
  }
  const OrientedMesh result = orientOutward(tube);
  EXPECT_EQ(result.quality.components, 2);
  EXPECT_NEAR(result.quality.volume, signedVolume(tube), 1e-12);
}

TEST(MeshQuality, AMoebiusStripIsNotTrusted) {
  TriangleMesh strip;
  constexpr int n = 30;
  for (int i = 0; i < n; ++i) {
    const double u = 2 * test::kPi * i / n;
    for (const double w : {-0.3, 0.3}) {
      const double rho = 1 + w * std::cos(u / 2);
      strip.vertices.emplace_back(rho * std::cos(u), rho * std::sin(u), w * std::sin(u / 2));
    }
  }
  for (int i = 0; i < n; ++i) {
    const int a = 2 * i, b = 2 * i + 1;
    const int c = i + 1 < n ? a + 2 : 1, d = i + 1 < n ? b + 2 : 0;
    strip.triangles.emplace_back(a, c, d);
    strip.triangles.emplace_back(a, d, b);
  }
  EXPECT_FALSE(orientOutward(strip).quality.sign_trusted);
}

TEST(MeshQuality, DegenerateTrianglesAreCounted) {
  TriangleMesh mesh = boxMesh({1, 1, 1});
  mesh.triangles.emplace_back(0, 0, 1);
  mesh.vertices.emplace_back(1, 0, 1);
  mesh.triangles.emplace_back(5, 8, 7);
  EXPECT_EQ(orientOutward(mesh).quality.degenerate_triangles, 2);
  TriangleMesh points;
  points.vertices = {{0, 0, 0}, {1, 0, 0}};
  points.triangles = {{0, 1, 1}};
  EXPECT_THROW(orientOutward(points), std::invalid_argument);
  EXPECT_THROW(orientOutward({}), std::invalid_argument);
}

TEST(MeshQuality, UnweldedTrianglesCountAsConnected) {
  TriangleMesh soup;
  for (const Vector3i& t : boxMesh({1, 1, 1}).triangles) {
    const int first = static_cast<int>(soup.vertices.size());
    for (int corner = 0; corner < 3; ++corner) soup.vertices.push_back(boxMesh({1, 1, 1}).vertices[t[corner]]);
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  EXPECT_TRUE(orientOutward(soup).quality.sign_trusted);
}

TEST(MeshQuality, OverlappingSolidsAreTrustedAndTheirUnionIsInside) {
  const TriangleMesh mesh = merged(boxMesh({1, 1, 1}), translated(icosphere(1, 3), {1, 1, 1}));
  const OrientedMesh result = orientOutward(mesh);
  EXPECT_TRUE(result.quality.sign_trusted);
  EXPECT_NEAR(TriangleTree(result.mesh).windingNumber({0.8, 0.8, 0.8}), 2, 0.05);
}

/// Faces of unit cells between a cell in the list and one that is not.
TriangleMesh boundaryOf(const std::vector<Vector3i>& cells) {
  TriangleMesh mesh;
  for (const Vector3i& cell : cells) {
    const Vector3d center = cell.cast<double>() + Vector3d::Constant(0.5);
    for (int face = 0; face < 6; ++face) {
      Vector3d out = Vector3d::Zero();
      out[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
      if (std::count(cells.begin(), cells.end(), Vector3i(cell + out.cast<int>())) > 0) continue;
      const Vector3d across = 0.5 * Vector3d(out.y(), out.z(), out.x()), up = out.cross(across);
      const int first = static_cast<int>(mesh.vertices.size());
      for (const auto& [i, k] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        mesh.vertices.push_back(center + 0.5 * out + i * across + k * up);
      mesh.triangles.emplace_back(first, first + 1, first + 2);
      mesh.triangles.emplace_back(first, first + 2, first + 3);
    }
  }
  return welded(mesh);
}

/// The block's corner may be cut out, or be a part of its own that was drawn inside out.
TEST(MeshQuality, WallsThatCloseOffACornerAreDoubtful) {
  std::vector<Vector3i> block;
  for (int i = 0; i < 8; ++i) block.emplace_back(i % 2, i / 2 % 2, i / 4);
  const TriangleMesh corner = boundaryOf({{1, 1, 1}});
  EXPECT_TRUE(orientOutward(boundaryOf(block)).quality.sign_trusted);
  EXPECT_TRUE(orientOutward(merged(boundaryOf(block), corner)).quality.sign_trusted);
  const MeshQuality quality = orientOutward(merged(boundaryOf(block), flipped(corner))).quality;
  EXPECT_TRUE(quality.doubtful);
  EXPECT_FALSE(quality.sign_trusted);
}

TEST(MeshQuality, APaneInAFrameStays) {
  std::vector<Vector3i> frame;
  for (int i = 0; i < 9; ++i)
    if (i != 4) frame.emplace_back(i % 3, i / 3, 0);
  TriangleMesh pane{{{1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}}, {{0, 1, 2}, {0, 2, 3}}};
  const MeshQuality quality = orientOutward(merged(boundaryOf(frame), merged(pane, flipped(pane)))).quality;
  EXPECT_EQ(quality.wall_triangles, 4);
}

}  // namespace sdf_ccd::mesh_quality_test
