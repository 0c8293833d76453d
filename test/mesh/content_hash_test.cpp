#include "mesh/content_hash.h"

#include <gtest/gtest.h>

#include "oracle/shapes.h"
#include "oracle/xxh64_twin.h"

namespace sdf_ccd::content_hash_test {

TEST(ContentHash, ATwinOfEqualXxh64HasAnotherHash) {
  for (const TriangleMesh& mesh : {test::boxMesh({0.1, 0.2, 0.3}), test::icosphere(0.1, 2)}) {
    const TriangleMesh twin = test::xxh64Twin(mesh);
    EXPECT_NE(contentHash(twin, {}), contentHash(mesh, {}));
    EXPECT_NE(contentHash(twin, {0.5, 1.0}), contentHash(mesh, {0.5, 1.0}));
    EXPECT_FALSE(areIdentical(twin, mesh));
    EXPECT_TRUE(areIdentical(twin, TriangleMesh(twin)));
  }
}

// The digest is that of Python's hashlib, over the same bytes: struct.pack('<3Q9d3i1d', 3, 1, 1, ...).
TEST(ContentHash, IsSha256InBase32) {
  TriangleMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.5}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(contentHash(mesh, {0.25}), "pb628sqfm9vjnhaiqej2icu1o82kuu14ifldd5s47fehjre5mgc0");
}

TEST(ContentHash, DependsOnEveryPart) {
  const TriangleMesh mesh = test::boxMesh({0.1, 0.2, 0.3});
  const std::string hash = contentHash(mesh, {1.0});
  EXPECT_EQ(contentHash(mesh, {1.0}), hash);
  EXPECT_NE(contentHash(mesh, {1.0, 0.0}), hash);
  EXPECT_NE(contentHash(mesh, {2.0}), hash);
  TriangleMesh other = mesh;
  std::swap(other.triangles[0], other.triangles[1]);
  EXPECT_NE(contentHash(other, {1.0}), hash);
}

}  // namespace sdf_ccd::content_hash_test
