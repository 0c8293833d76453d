#include "solid/conforming_mesh.h"

#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::conforming_mesh_test {

using test::Random;

void add(TriangleMesh& mesh, const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const int first = static_cast<int>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// A box of which one edge is divided at `share` of its length on one of its two faces only, as tessellated apart.
/// @param filled  whether a triangle without height fills that seam, as some programs write.
TriangleMesh boxWithSeam(double share, bool filled) {
  TriangleMesh box = test::boxMesh({0.1, 0.1, 0.1});
  const Vector3i divided = box.triangles.front();
  box.triangles.erase(box.triangles.begin());
  const Vector3d a = box.vertices[divided[0]], b = box.vertices[divided[1]], c = box.vertices[divided[2]];
  const Vector3d on = a + share * (b - a);
  add(box, a, on, c);
  add(box, on, b, c);
  if (filled) add(box, on, a, b);
  return box;
}

/// A needle of two faces, back to back.
void addNeedle(TriangleMesh& mesh, const Vector3d& from, const Vector3d& to, double width) {
  const Vector3d side = width * (to - from).unitOrthogonal();
  add(mesh, from, from + side, to);
  add(mesh, from + side, from, to);
}

/// How far points of the original lie from the surface, at most.
double farthest(const TriangleMesh& original, const TriangleMesh& mesh) {
  double most = 0.0;
  for (const Vector3i& t : original.triangles) {
    const Vector3d &a = original.vertices[t[0]], &b = original.vertices[t[1]], &c = original.vertices[t[2]];
    for (const Vector3d& p : {a, b, c, Vector3d(0.5 * (a + b)), Vector3d(0.5 * (b + c)), Vector3d(0.5 * (c + a))})
      most = std::max(most, test::distance(mesh, p));
  }
  return most;
}

TEST(ConformingMesh, FacesWithDividedSidesAreJoined) {
  for (const double share : {0.5, 0.3, 1e-3}) {
    const TriangleMesh mesh = welded(boxWithSeam(share, false));
    ASSERT_FALSE(isClosed(mesh));
    const ConformingMesh joined = conformingMesh(mesh);
    EXPECT_TRUE(isClosed(joined.mesh)) << share;
    EXPECT_EQ(joined.mesh.triangles.size(), 14u) << "twelve, of which two are divided";
    EXPECT_LE(joined.moved, 1e-6);
  }
}

TEST(ConformingMesh, SeamsAreDropped) {
  TriangleMesh mesh = boxWithSeam(0.5, true);
  for (int k = 0; k < 3; ++k) mesh.vertices[mesh.triangles.back()[k]].z() += 1e-16 * (k + 1);  // no longer connected
  mesh = welded(mesh);
  ASSERT_FALSE(isClosed(mesh));
  const ConformingMesh joined = conformingMesh(mesh);
  EXPECT_TRUE(isClosed(joined.mesh));
  EXPECT_EQ(joined.mesh.triangles.size(), 14u);
  EXPECT_LE(joined.moved, 1e-6);
}

/// Its height is that of a seam, but nothing else is where it is.
TEST(ConformingMesh, ANeedleIsNoSeam) {
  for (const double width : {1e-13, 1e-10, 1e-8}) {
    TriangleMesh mesh = boxWithSeam(0.4, true);
    addNeedle(mesh, {0.2, 0, 0}, {0.5, 0.1, 0}, width);      // free
    addNeedle(mesh, {0, 0.02, 0.1}, {0, 0.04, 0.4}, width);  // on a face
    mesh = welded(mesh);
    const ConformingMesh joined = conformingMesh(mesh);
    EXPECT_LE(farthest(mesh, joined.mesh), joined.moved + 1e-12) << width;
    EXPECT_LE(joined.moved, 1e-6);
    EXPECT_EQ(joined.source.size(), joined.mesh.triangles.size());
  }
}

/// Rows of seams of seams, needles, and vertices that differ by rounding: no point is farther than it is said.
TEST(ConformingMesh, NoPointMovesFartherThanItIsSaid) {
  Random random(5);
  int joined_meshes = 0;
  for (int trial = 0; trial < 300; ++trial) {
    TriangleMesh mesh = boxWithSeam(test::uniform(random, 0.1, 0.9), trial % 2 == 0);
    const std::size_t triangles = mesh.triangles.size();
    for (int i = 0; i < trial % 4; ++i) {
      const Vector3i t = mesh.triangles[static_cast<std::size_t>(test::uniform(random, 0.0, double(triangles)))];
      const Vector3d a = mesh.vertices[t[0]], b = mesh.vertices[t[1]];
      const Vector3d on = a + test::uniform(random, 0.0, 1.3) * (b - a) +
                          std::pow(10.0, test::uniform(random, -16, -6)) * test::direction(random);
      add(mesh, a, b, on);
      if (i % 2 == 1) add(mesh, b, a, on);
    }
    if (trial % 3 == 0) addNeedle(mesh, 0.1 * test::direction(random), test::direction(random), 1e-9);
    for (Vector3d& p : mesh.vertices) p += 1e-14 * test::direction(random);
    mesh = welded(mesh);
    const ConformingMesh joined = conformingMesh(mesh);
    joined_meshes += joined.moved > 0.0;
    EXPECT_LE(farthest(mesh, joined.mesh), joined.moved + 1e-14) << trial;
  }
  EXPECT_GT(joined_meshes, 100);
}

}  // namespace sdf_ccd::conforming_mesh_test
