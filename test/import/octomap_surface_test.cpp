#include "sdf_ccd/mesh.h"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <vector>

#include "oracle/failure.h"
#include "oracle/files.h"
#include "oracle/test_data.h"

namespace sdf_ccd::octomap_surface_test {

/// Whether every directed edge occurs as often as its opposite, as in a closed surface.
bool edgesBalance(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> balance;
  for (const Vector3i& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const int a = t[i];
      const int b = t[(i + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  for (const auto& edge : balance) {
    if (edge.second != 0) return false;
  }
  return true;
}

class OctomapFile : public ::testing::Test {
 protected:
  void SetUp() override {
    double resolution = 0.0;
    const std::string failed = test::failureOf([&] { loadOctomapSurface(write({}), resolution); });
    if (failed.find("has no OctoMap") != std::string::npos) GTEST_SKIP() << failed;
  }

  std::string write(const std::string& bytes) {
    test::writeText(path_, bytes);
    return path_.string();
  }

  /// The error message of loading these bytes.
  std::string failure(const std::string& bytes) {
    double resolution = 0.0;
    const std::string failure = test::failureOf([&] { loadOctomapSurface(write(bytes), resolution); });
    EXPECT_NE(failure.find(path_.string()), std::string::npos) << failure;
    return failure;
  }

  const test::TemporaryDirectory directory_;
  const std::filesystem::path path_ = directory_ / "map.bt";
};

std::string head(int nodes, const std::string& resolution = "0.25") {
  return "# Octomap OcTree binary file\n# a comment\n#\nid OcTree\nsize " + std::to_string(nodes) + "\nres " +
         resolution + "\ndata\n";
}

/// A node of the binary format, two bytes, from its eight children (0 unknown, 1 free, 2 occupied, 3 a node that
/// follows).
std::string node(const std::vector<int>& children) {
  unsigned bits = 0;
  for (int i = 0; i < 8; ++i) bits |= static_cast<unsigned>(children[i]) << (2 * i);
  return {static_cast<char>(bits & 255), static_cast<char>(bits >> 8)};
}

/// A tree of `levels` levels with a single branch, towards the voxels above the origin, that ends with the node `last`.
std::string branch(const std::string& last, int levels) {
  std::string bytes = node({0, 0, 0, 0, 0, 0, 0, 3});
  for (int i = 0; i < levels - 2; ++i) bytes += node({3, 0, 0, 0, 0, 0, 0, 0});
  return bytes + last;
}

TEST_F(OctomapFile, OneVoxelIsACubeOnTheGrid) {
  double resolution = 0.0;
  const TriangleMesh mesh =
      loadOctomapSurface(write(head(17) + branch(node({2, 0, 0, 0, 0, 0, 0, 0}), 16)), resolution);
  EXPECT_EQ(resolution, 0.25);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.vertices.size(), 8u);
  EXPECT_TRUE(edgesBalance(mesh));
  EXPECT_DOUBLE_EQ(signedVolume(mesh), std::pow(0.25, 3));
  EXPECT_EQ(boundingBox(mesh).min(), Vector3d(0, 0, 0));
  EXPECT_EQ(boundingBox(mesh).max(), Vector3d(0.25, 0.25, 0.25));
}

TEST_F(OctomapFile, LargeLeafHasFacesOfTheFinestSize) {
  // A leaf two levels up: 4 × 4 × 4 voxels.
  double resolution = 0.0;
  const TriangleMesh mesh =
      loadOctomapSurface(write(head(15) + branch(node({2, 0, 0, 0, 0, 0, 0, 0}), 14)), resolution);
  EXPECT_EQ(mesh.triangles.size(), 6u * 16u * 2u);
  EXPECT_TRUE(edgesBalance(mesh));
  EXPECT_DOUBLE_EQ(signedVolume(mesh), 1.0);
}

TEST_F(OctomapFile, LeavesOfDifferentSizeShareNoInnerFace) {
  // A leaf of 2 × 2 × 2 voxels, and beside it (+x) one divided into eight of which one, at its lower corner, is
  // occupied.
  const std::string last = node({2, 3, 0, 0, 0, 0, 0, 0}) + node({2, 1, 1, 1, 1, 1, 1, 1});
  double resolution = 0.0;
  const TriangleMesh mesh = loadOctomapSurface(write(head(25) + branch(last, 15)), resolution);
  EXPECT_EQ(mesh.triangles.size(), 2u * (6 * 4 + 6 - 2));
  EXPECT_TRUE(edgesBalance(mesh));
  EXPECT_DOUBLE_EQ(signedVolume(mesh), 9.0 * std::pow(0.25, 3));
}

TEST_F(OctomapFile, VoxelsThatTouchAtAnEdgeStayClosed) {
  double resolution = 0.0;
  const TriangleMesh mesh =
      loadOctomapSurface(write(head(18) + branch(node({2, 0, 0, 2, 0, 0, 0, 0}), 16)), resolution);
  EXPECT_EQ(mesh.triangles.size(), 24u);
  EXPECT_EQ(mesh.vertices.size(), 14u);
  EXPECT_TRUE(edgesBalance(mesh));
}

TEST_F(OctomapFile, FormatOf2010NeedsNoHeader) {
  std::string bytes(16, '\0');
  const std::int32_t type = 3;
  const double size = 0.5;
  const std::uint32_t nodes = 17;
  std::memcpy(&bytes[0], &type, 4);
  std::memcpy(&bytes[4], &size, 8);
  std::memcpy(&bytes[12], &nodes, 4);
  double resolution = 0.0;
  const TriangleMesh mesh = loadOctomapSurface(write(bytes + branch(node({0, 0, 0, 0, 0, 0, 0, 2}), 16)), resolution);
  EXPECT_EQ(resolution, 0.5);
  EXPECT_EQ(boundingBox(mesh).min(), Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(boundingBox(mesh).max(), Vector3d(1.0, 1.0, 1.0));
}

TEST_F(OctomapFile, DamagedFilesAreRefusedWithTheReason) {
  const std::string good = head(17) + branch(node({2, 0, 0, 0, 0, 0, 0, 0}), 16);
  for (std::size_t bytes = 0; bytes < good.size(); ++bytes) {
    EXPECT_NE(failure(good.substr(0, bytes)), "") << bytes;
  }
  EXPECT_NE(failure("solid nothing").find("not an OctoMap file"), std::string::npos);
  EXPECT_NE(failure(head(1) + std::string(100000, '\xff')).find("more than 16 levels"), std::string::npos);
  EXPECT_NE(failure(head(99) + branch(node({2, 0, 0, 0, 0, 0, 0, 0}), 16)).find("99 nodes"), std::string::npos);
  EXPECT_NE(failure(head(17, "-1") + branch(node({2, 0, 0, 0, 0, 0, 0, 0}), 16)).find(" -1"), std::string::npos);
  EXPECT_NE(failure(head(17) + branch(node({1, 0, 0, 0, 0, 0, 0, 0}), 16)).find("occupied"), std::string::npos);
  EXPECT_NE(failure("# Octomap OcTree file\nid Mine\nsize 1\nres 1\ndata\n     ").find("Mine"), std::string::npos);
}

TEST_F(OctomapFile, MissingFileAndDirectoryAreNamed) {
  double resolution = 0.0;
  EXPECT_THROW(loadOctomapSurface("/no/such/map.bt", resolution), std::runtime_error);
  EXPECT_THROW(loadOctomapSurface(std::filesystem::temp_directory_path().string(), resolution), std::runtime_error);
}

TEST_F(OctomapFile, RealMapIsClosedInBothFormats) {
  SDF_CCD_NEEDS_DATA("octomaps/geb079.bt");
  double resolution = 0.0;
  const TriangleMesh binary = loadOctomapSurface(test::dataPath("octomaps/geb079.bt"), resolution);
  EXPECT_NEAR(resolution, 0.08, 1e-12);
  EXPECT_EQ(binary.triangles.size(), 714020u);
  EXPECT_TRUE(edgesBalance(binary));
  EXPECT_NEAR(signedVolume(binary) / std::pow(resolution, 3), 185673.0, 1e-3);
  for (const Vector3d& p : binary.vertices) {
    for (int i = 0; i < 3; ++i) ASSERT_EQ(p[i], std::round(p[i] / resolution) * resolution);
  }

  SDF_CCD_NEEDS_DATA("octomaps/derived_geb079.ot");
  const TriangleMesh full = loadOctomapSurface(test::dataPath("octomaps/derived_geb079.ot"), resolution);
  EXPECT_EQ(full.triangles.size(), binary.triangles.size());
}

TEST_F(OctomapFile, RealMapOf2010) {
  SDF_CCD_NEEDS_DATA("octomaps/simple_2010.bt");
  double resolution = 0.0;
  const TriangleMesh mesh = loadOctomapSurface(test::dataPath("octomaps/simple_2010.bt"), resolution);
  EXPECT_EQ(mesh.triangles.size(), 4800u);
  EXPECT_TRUE(edgesBalance(mesh));
}

}  // namespace sdf_ccd::octomap_surface_test
