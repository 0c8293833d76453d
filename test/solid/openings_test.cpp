#include "solid/openings/openings.h"

#include <gtest/gtest.h>

#include "oracle/open_shapes.h"
#include "oracle/random.h"
#include "oracle/winding_number.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/primitive.h"

namespace sdf_ccd::openings_test {

using test::distance;
using test::Random;

TriangleMesh closedMesh(const TriangleMesh& mesh, const Openings& openings) {
  return welded(merged(mesh, openings.caps));
}

double largestReach(const Openings& openings) {
  return openings.reach.empty() ? 0.0 : *std::max_element(openings.reach.begin(), openings.reach.end());
}

TEST(Openings, AClosedMeshHasNone) {
  for (const TriangleMesh& mesh : {test::boxMesh({1, 2, 3}), test::icosphere(1, 2), test::torusMesh(1, 0.3, 24, 12)}) {
    const Openings openings = findOpenings(mesh);
    EXPECT_TRUE(openings.caps.triangles.empty());
    EXPECT_EQ(summary(openings), "no openings");
  }
}

TEST(Openings, ALidlessBinGetsItsLid) {
  const TriangleMesh bin = test::binMesh(0.22);
  const Openings openings = findOpenings(bin);
  EXPECT_EQ(openings.count, 1);
  EXPECT_EQ(openings.caps.triangles.size(), 2U);
  EXPECT_NEAR(openings.area, 0.44 * 0.44, 1e-12);
  EXPECT_NEAR(openings.longest, 4 * 0.44, 1e-12);
  EXPECT_EQ(openings.doubt, 0.0);
  EXPECT_TRUE(isClosed(closedMesh(bin, openings)));
  // The middle of the lid is 0.22 m from the rim, and the bound is not far above.
  EXPECT_GE(largestReach(openings), 0.22);
  EXPECT_LE(largestReach(openings), 0.45);
  EXPECT_EQ(summary(openings), "1 opening, the longest 1.76 m around, 0.194 m^2 of caps");
}

/// With random triangles removed from different meshes, and the others flipped at random or not.
TEST(Openings, TheResultIsClosed) {
  Random random(1);
  for (int i = 0; i < 60; ++i) {
    TriangleMesh mesh = i % 3 == 0 ? test::icosphere(1, 2)
                        : i % 3 == 1
                            ? test::torusMesh(1, 0.3, 24, 12)
                            : merged(test::boxMesh({1, 1, 1}), test::translated(test::boxMesh({1, 1, 1}), {0, 2, 0}));
    const double lost = test::uniform(random, 0.0, 1.0);
    mesh = test::without(mesh, [&](const Vector3d&) { return test::uniform(random, 0, 1) < lost; });
    if (mesh.triangles.empty()) continue;
    if (i % 2) {
      for (Vector3i& t : mesh.triangles) {
        if (random() % 2) std::swap(t[1], t[2]);
      }
    }
    const Openings openings = findOpenings(mesh);
    EXPECT_TRUE(isClosed(closedMesh(mesh, openings))) << i;
    ASSERT_EQ(openings.reach.size(), openings.caps.triangles.size());
    for (std::size_t k = 0; k < openings.reach.size(); ++k) {
      const Vector3i& t = openings.caps.triangles[k];
      for (int n = 0; n < 5; ++n) {
        double u = test::uniform(random, 0, 1), v = test::uniform(random, 0, 1);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const std::vector<Vector3d>& c = openings.caps.vertices;
        const Vector3d p = c[t[0]] + u * (c[t[1]] - c[t[0]]) + v * (c[t[2]] - c[t[0]]);
        ASSERT_LE(distance(mesh, p), openings.reach[k] + 1e-12);
      }
    }
  }
}

/// The triangles separated, with their corners moved by up to `crack`: no edge is shared any more.
TriangleMesh cracked(const TriangleMesh& mesh, double crack, Random& random) {
  TriangleMesh result;
  for (const Vector3i& t : mesh.triangles) {
    const int first = static_cast<int>(result.vertices.size());
    for (int k = 0; k < 3; ++k) {
      result.vertices.push_back(mesh.vertices[t[k]] + test::uniform(random, 0, crack) * test::direction(random));
    }
    result.triangles.emplace_back(first, first + 1, first + 2);
  }
  return result;
}

TEST(Openings, CracksGetSlivers) {
  Random random(2);
  for (const double crack : {1e-9, 1e-7, 1e-6, 1e-5, 4e-5}) {
    for (const TriangleMesh& mesh : {test::boxMesh({1, 1, 1}), test::icosphere(1, 2), test::torusMesh(1, 0.4, 16, 8)}) {
      const double size = boundingBox(mesh).diagonal().norm();
      const TriangleMesh open = cracked(mesh, crack * size, random);
      const Openings openings = findOpenings(open);
      EXPECT_EQ(openings.count, 0) << crack;
      EXPECT_EQ(openings.doubt, 0.0);
      EXPECT_LE(largestReach(openings), 30 * crack * size) << crack;
      const TriangleMesh closed = closedMesh(open, openings);
      ASSERT_TRUE(isClosed(closed));
      for (int i = 0; i < 200; ++i) {
        const Vector3d p = test::uniformIn(random, boundingBox(mesh));
        if (distance(mesh, p) < 1e-3) continue;
        EXPECT_NEAR(test::windingNumber(closed, p), test::windingNumber(mesh, p), 1e-9);
      }
    }
  }
}

/// Two panels, up to `crack` apart, meet along an edge that each divides differently.
TEST(Openings, JunctionsWithoutSharedVerticesGetSlivers) {
  Random random(3);
  for (const double crack : {0.0, 1e-7, 5e-5}) {
    // A box whose lid is a fan over its own divisions of the rim.
    TriangleMesh box = test::binMesh(1.0);
    std::vector<Vector3d> rim;
    for (const auto& [from, to] :
         {std::pair(Vector3d(1, 1, 1), Vector3d(-1, 1, 1)), std::pair(Vector3d(-1, 1, 1), Vector3d(-1, -1, 1)),
          std::pair(Vector3d(-1, -1, 1), Vector3d(1, -1, 1)), std::pair(Vector3d(1, -1, 1), Vector3d(1, 1, 1))}) {
      for (const double share : {0.0, 0.2, 0.37, 0.9}) {
        rim.push_back(from + share * (to - from) + test::uniform(random, 0, crack) * test::direction(random));
      }
    }
    const int first = static_cast<int>(box.vertices.size()), n = static_cast<int>(rim.size());
    box.vertices.insert(box.vertices.end(), rim.begin(), rim.end());
    box.vertices.emplace_back(0, 0, 1);
    for (int i = 0; i < n; ++i) box.triangles.emplace_back(first + i, first + (i + 1) % n, first + n);
    const Openings openings = findOpenings(box);
    EXPECT_EQ(openings.count, 0) << crack;
    EXPECT_LE(largestReach(openings), 3 * crack + 1e-12);
    const TriangleMesh closed = closedMesh(box, openings);
    EXPECT_TRUE(isClosed(closed));
    EXPECT_NEAR(test::windingNumber(closed, {0.3, 0.2, 0.9}), 1.0, 1e-9);
    EXPECT_NEAR(test::windingNumber(closed, {0.3, 0.2, 1.1}), 0.0, 1e-9);
  }
}

/// The rims of a wall with two sides get one strip between them, no two lids.
TEST(Openings, TheRimsOfADoubleWallShareACap) {
  const TriangleMesh outer = test::binMesh(1.0), inner = test::flipped(test::binMesh(0.9));
  const Openings openings = findOpenings(merged(outer, test::translated(inner, {0, 0, 0.1})));
  EXPECT_NEAR(openings.area, 4.0 - 1.8 * 1.8, 1e-9);
  EXPECT_EQ(openings.count, 2);
}

/// A box of six panels, 4 % of its side apart at the edges: what is inside is inside, by wider joins.
TEST(Openings, PanelsWithWideGapsEncloseWhatIsBetween) {
  TriangleMesh panels;
  for (const Vector3i& t : test::boxMesh({1, 1, 1}).triangles) {
    const TriangleMesh box = test::boxMesh({1, 1, 1});
    const Vector3d normal = areaNormal({box.vertices, {t}}, 0).normalized();
    TriangleMesh panel{box.vertices, {t}};
    for (Vector3d& v : panel.vertices) v = 0.96 * (v - v.dot(normal) * normal) + v.dot(normal) * normal;
    panels = merged(panels, panel);
  }
  const Openings openings = findOpenings(panels);
  const TriangleMesh closed = closedMesh(panels, openings);
  EXPECT_TRUE(isClosed(closed));
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-0.8), Vector3d::Constant(0.8)});
    EXPECT_GT(std::abs(test::windingNumber(closed, p)), 0.5) << p.transpose();
  }
}

/// A sheet alone has no inside.
TEST(Openings, ASheetIsCappedByItself) {
  TriangleMesh sheet;
  sheet.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
  const Openings openings = findOpenings(sheet);
  EXPECT_EQ(openings.caps.triangles.size(), 2U);
  EXPECT_LE(largestReach(openings), 1e-12);
}

}  // namespace sdf_ccd::openings_test
