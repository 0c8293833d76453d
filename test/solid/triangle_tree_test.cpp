#include "mesh/triangle_tree.h"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "mesh/triangle.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "oracle/winding_number.h"

namespace sdf_ccd::triangle_tree_test {

/// Triangles of every size, needles and specks among them.
TriangleMesh randomSoup(int count, std::uint64_t seed) {
  test::Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vector3d center = test::pointInCube(random, 1);
    const double size = std::pow(10.0, -4 * std::abs(test::pointInCube(random, 1).x()));
    for (int corner = 0; corner < 3; ++corner) mesh.vertices.push_back(center + test::pointInCube(random, size));
    if (i % 7 == 0) mesh.vertices.back() = mesh.vertices[3 * i] + 1e-9 * test::pointInCube(random, 1);
    if (i % 50 == 0) mesh.vertices.back() = (mesh.vertices[3 * i] + mesh.vertices[3 * i + 1]) / 2;
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

double bruteDistance(const TriangleMesh& mesh, const Vector3d& p) {
  double best = kInfinity;
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d q = closestOnTriangle(cornersOf(mesh.vertices, t), p);
    best = std::min(best, (q - p).norm());
  }
  return best;
}

TEST(TriangleTree, ClosestPointEqualsBruteForce) {
  const TriangleMesh mesh = randomSoup(700, 1);
  const TriangleTree tree(mesh);
  test::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = test::pointInCube(random, i % 2 ? 1.1 : 5);
    const TriangleTree::ClosestPoint found = tree.closestPoint(p);
    EXPECT_DOUBLE_EQ(found.distance, bruteDistance(mesh, p));
    EXPECT_DOUBLE_EQ((found.point - p).norm(), found.distance);
    ASSERT_GE(found.triangle, 0);
    EXPECT_EQ(found.point, closestOnTriangle(cornersOf(mesh, found.triangle), p));
  }
}

TEST(TriangleTree, FlatPiecesSeenFromAboveLoseNothing) {
  const TriangleMesh mesh = test::torusMesh(1, 0.3, 60, 20);
  const TriangleTree tree(mesh);
  test::Random random(9);
  int last = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = test::pointInCube(random, std::pow(10.0, i % 5 - 1));
    const TriangleTree::ClosestPoint found = tree.closestPointNear(p, last);
    EXPECT_DOUBLE_EQ(found.distance, bruteDistance(mesh, p));
    last = found.triangle;
  }
}

TEST(FlatCylinder, HoldsWhatItWasMadeOf) {
  test::Random random(10);
  for (int i = 0; i < 200; ++i) {
    FlatCylinder cylinder{test::pointInCube(random, 1), test::pointInCube(random, 1).normalized()};
    if (i % 10 == 0) cylinder.axis.setZero();
    std::vector<Vector3d> held;
    for (int k = 0; k < 5; ++k) held.push_back(test::pointInCube(random, 1));
    for (const Vector3d& p : held) cylinder.extend(p);
    const Vector3d p = test::pointInCube(random, 5);
    double nearest = kInfinity;
    for (const Vector3d& q : held) nearest = std::min(nearest, (q - p).norm());
    EXPECT_TRUE(cylinder.mayBeWithin(nearest, p));
  }
}

TEST(FlatCylinder, TellsTheDistanceOfADiscFromAllSides) {
  const FlatCylinder disc{Vector3d::Zero(), Vector3d::UnitZ(), 1.0, 0.5};
  const auto expectDistance = [&](double distance, const Vector3d& p) {
    EXPECT_TRUE(disc.mayBeWithin(distance * (1 + 1e-9), p));
    EXPECT_FALSE(disc.mayBeWithin(distance * (1 - 1e-9), p));
  };
  expectDistance(1.5, {0.5, 0.5, 2});
  expectDistance(1.5, {0.5, 0.5, -2});
  expectDistance(3, {0, 4, 0.2});
  expectDistance(5, {0, 4, 4.5});
  EXPECT_TRUE(disc.mayBeWithin(0.0, {0.5, 0.5, 0.4}));
}

TEST(TriangleTree, MaxDistanceCutsOffExactlyThere) {
  const TriangleTree tree(test::boxMesh({1, 1, 1}));
  EXPECT_EQ(tree.closestPoint({3, 0, 0}, 2.5).triangle >= 0, true);
  const TriangleTree::ClosestPoint none = tree.closestPoint({3, 0, 0}, 2.0);
  EXPECT_EQ(none.triangle, -1);
  EXPECT_EQ(none.distance, 2.0);
  EXPECT_EQ(tree.closestPoint({3, 0, 0}, 0.0).triangle, -1);
}

TEST(TriangleTree, FarthestAlongEqualsBruteForce) {
  const TriangleMesh mesh = randomSoup(700, 5);
  const TriangleTree tree(mesh);
  test::Random random(6);
  int found_some = 0, stopped = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = test::pointInCube(random, 1.1), n = test::pointInCube(random, 1).normalized();
    const double radius = std::abs(test::pointInCube(random, i % 2 ? 0.1 : 1.0).x());
    double farthest = -radius;
    for (const Vector3i& t : mesh.triangles) {
      const Corners corners = cornersOf(mesh.vertices, t);
      if ((closestOnTriangle(corners, p) - p).norm() > radius) continue;
      for (const Vector3d& corner : corners) farthest = std::max(farthest, n.dot(corner - p));
    }
    EXPECT_DOUBLE_EQ(tree.farthestAlong(n, p, radius, kInfinity), farthest);
    EXPECT_DOUBLE_EQ(tree.farthestAlong(n, p, radius, farthest), farthest);
    const double less = farthest - 0.1 * radius, beyond = tree.farthestAlong(n, p, radius, less);
    EXPECT_LE(beyond, farthest + 1e-15);
    EXPECT_TRUE(beyond > less || farthest == -radius);
    found_some += farthest > -radius;
    stopped += beyond < farthest;
  }
  EXPECT_GT(found_some, 500);
  EXPECT_GT(stopped, 10);
}

TEST(TriangleTree, FullWindingNumberEqualsBruteForce) {
  const TriangleMesh mesh = randomSoup(300, 3);
  const TriangleTree tree(mesh);
  test::Random random(4);
  for (int i = 0; i < 300; ++i) {
    const Vector3d p = test::pointInCube(random, 1.5);
    EXPECT_NEAR(tree.windingNumber(p, kInfinity), test::windingNumber(mesh, p), 1e-11);
  }
}

TEST(TriangleTree, FastWindingNumberIsNearAndConvergesWithAccuracy) {
  const TriangleMesh mesh = test::torusMesh(1, 0.3, 120, 40);
  const TriangleTree tree(mesh);
  test::Random random(5);
  double worst2 = 0, worst4 = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = test::pointInCube(random, 1.5);
    const double exact = test::windingNumber(mesh, p);
    worst2 = std::max(worst2, std::abs(tree.windingNumber(p) - exact));
    worst4 = std::max(worst4, std::abs(tree.windingNumber(p, 4) - exact));
  }
  EXPECT_LT(worst2, 0.02);
  EXPECT_GT(worst2, 1e-5);  // the hierarchy is at work
  EXPECT_LT(worst4, worst2 / 5);
}

TEST(TriangleTree, ExpansionHoldsForOpenMeshes) {
  // Half a sphere: clusters with a net dipole, where an error in the first term would show.
  TriangleMesh mesh = test::icosphere(1, 4);
  std::vector<Vector3i> upper;
  for (const Vector3i& t : mesh.triangles) {
    if (mesh.vertices[t[0]].z() + mesh.vertices[t[1]].z() + mesh.vertices[t[2]].z() > 0) upper.push_back(t);
  }
  mesh.triangles = upper;
  const TriangleTree tree(mesh);
  test::Random random(6);
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = test::pointInCube(random, 3);
    EXPECT_NEAR(tree.windingNumber(p), test::windingNumber(mesh, p), 0.01);
  }
}

TEST(TriangleTree, WindingNumberTellsInsideFromOutside) {
  const TriangleTree tree(test::icosphere(1, 4));
  test::Random random(7);
  for (int i = 0; i < 5000; ++i) {
    const Vector3d p = test::pointInCube(random, 1.5);
    if (p.norm() > 0.99 && p.norm() < 1.0001) continue;  // between the sphere and its chords
    EXPECT_NEAR(tree.windingNumber(p), p.norm() < 1 ? 1 : 0, 0.02);
  }
}

TEST(TriangleTree, InsideIsRightWhereManyLayersNearlyCoincide) {
  for (const double shift : {0.0, 1e-6, 1e-3}) {
    test::Random random(11);
    TriangleMesh mesh = test::boxMesh({1, 1, 1});
    for (int i = 1; i < 600; ++i) {
      mesh = merged(mesh, test::translated(test::boxMesh({1, 1, 1}), test::pointInCube(random, shift)));
    }
    const TriangleTree tree(mesh);
    double worst = 0;
    for (int i = 0; i < 1000; ++i) {
      const Vector3d p = test::pointInCube(random, 4);
      const double outside = p.cwiseAbs().maxCoeff() - 1;
      if (std::abs(outside) < 0.01) continue;
      EXPECT_EQ(tree.inside(p, TriangleTree::Inside::kNotZero), outside < 0) << p.transpose();
      EXPECT_EQ(tree.inside(p, TriangleTree::Inside::kAboveHalf), outside < 0) << p.transpose();
      worst = std::max(worst, std::abs(tree.windingNumber(p) - (outside < 0 ? 600 : 0)));
    }
    EXPECT_GT(worst, 0.5);  // the number alone would not do
  }
}

TEST(TriangleTree, InsideAgreesWithTheFullWindingNumber) {
  // Open, inside out, and with parts that overlap: above one half, and not zero.
  const TriangleMesh closed = merged(test::torusMesh(1, 0.3, 60, 20), test::flipped(test::icosphere(0.9, 3)));
  TriangleMesh open = closed;
  open.triangles.resize(open.triangles.size() * 3 / 4);
  const TriangleTree closed_tree(closed), open_tree(open);
  test::Random random(12);
  int inside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = test::pointInCube(random, 1.5);
    const double whole = test::windingNumber(closed, p), part = test::windingNumber(open, p);
    EXPECT_EQ(closed_tree.inside(p, TriangleTree::Inside::kNotZero), std::abs(whole) > 0.5);
    inside += std::abs(whole) > 0.5;
    if (std::abs(part - 0.5) < 1e-5) continue;
    EXPECT_EQ(open_tree.inside(p, TriangleTree::Inside::kAboveHalf), part > 0.5);
  }
  EXPECT_GT(inside, 300);
}

TEST(TriangleTree, PointsOnTheMeshAreNotNan) {
  const TriangleMesh mesh = test::translated(test::icosphere(0.3, 2), {1, 2, 3});
  const TriangleTree tree(mesh);
  for (const Vector3i& t : mesh.triangles) {
    const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
    for (const Vector3d& p : {a, Vector3d((a + b) / 2), Vector3d((a + b + c) / 3)}) {
      EXPECT_LT(tree.closestPoint(p).distance, 1e-15);
      const double winding = tree.windingNumber(p);
      // On an edge, rounding puts the point on either side of both triangles.
      EXPECT_GT(winding, -0.6);
      EXPECT_LT(winding, 1.6);
    }
  }
}

TEST(TriangleTree, ManyEqualAndManyNestedTrianglesKeepTheTreeShallow) {
  TriangleMesh mesh;
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(0.8, i % 600);  // centres in geometric progression, and five copies of each
    const int first = static_cast<int>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), {{size, 0, 0}, {size, size, 0}, {size, 0, size}});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  const TriangleTree tree(mesh);
  for (const Vector3d& p : {Vector3d(0, 0, 0), Vector3d(0.3, 0.2, 0.1), Vector3d(2, 2, 2)}) {
    EXPECT_DOUBLE_EQ(tree.closestPoint(p).distance, bruteDistance(mesh, p));
    EXPECT_NEAR(tree.windingNumber(p), test::windingNumber(mesh, p), 2.0);
  }
}

TEST(TriangleTree, FarFromTheOriginNothingIsLost) {
  const Vector3d offset(1e5, -2e5, 3e5);
  const TriangleTree tree(test::translated(test::boxMesh({1, 1, 1}), offset));
  EXPECT_NEAR(tree.closestPoint(offset + Vector3d(0, 0, 3)).distance, 2, 1e-9);
  EXPECT_NEAR(tree.windingNumber(offset, kInfinity), 1, 1e-9);
  EXPECT_NEAR(tree.windingNumber(offset + Vector3d(2, 1, 0), kInfinity), 0, 1e-9);
}

TEST(TriangleTree, BadMeshesAreRefused) {
  EXPECT_THROW(TriangleTree{TriangleMesh{}}, std::invalid_argument);
}

TEST(Triangle, ClosestPointAgreesWithDenseSampling) {
  test::Random random(8);
  for (int i = 0; i < 300; ++i) {
    const Vector3d a = test::pointInCube(random, 1), b = test::pointInCube(random, 1);
    // From fat triangles to needles to a segment.
    const Vector3d c = i % 3 == 0 ? test::pointInCube(random, 1)
                       : i % 3 == 1
                           ? Vector3d(a + 0.4 * (b - a) + std::pow(10.0, -i / 20) * test::pointInCube(random, 1))
                           : Vector3d(a + 0.4 * (b - a));
    const Vector3d p = test::pointInCube(random, 2);
    const double found = (closestOnTriangle({a, b, c}, p) - p).norm();
    double sampled = kInfinity;
    constexpr int n = 60;
    for (int j = 0; j <= n; ++j) {
      for (int k = 0; k + j <= n; ++k) {
        sampled = std::min(sampled, (a + (b - a) * (double(j) / n) + (c - a) * (double(k) / n) - p).norm());
      }
    }
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GE(found, sampled - 0.1);
  }
}

TEST(Triangle, DegenerateTrianglesHaveNoSolidAngleAndNoNan) {
  const Vector3d a(0, 0, 0), b(1, 0, 0);
  EXPECT_EQ(closestOnTriangle({a, a, a}, b), a);
  EXPECT_TRUE(closestOnTriangle({a, b, a}, Vector3d(0.5, 1, 0)).isApprox(Vector3d(0.5, 0, 0)));
  SolidAngleSum at_corner(a), beside(Vector3d(0.5, 1, 0));
  at_corner.add({a, a, a});
  EXPECT_EQ(at_corner.value(), 0);
  beside.add({a, b, a});
  EXPECT_EQ(beside.value(), 0);
}

TEST(SolidAngleSum, EqualsTheSumOfArcTangents) {
  test::Random random(11);
  for (const double size : {1e-9, 1e-3, 1.0, 1e6}) {
    for (int round = 0; round < 200; ++round) {
      // Mostly near p, and some flat before it, so that the sum goes through many turns in either direction.
      TriangleMesh mesh;
      const Vector3d p = size * test::uniformIn(random, AlignedBox3d(Vector3d(-1, -1, -1), Vector3d(1, 1, 1)));
      const double sign = round % 2 == 0 ? 1.0 : -1.0, height = std::pow(10.0, -(round % 9));
      SolidAngleSum sum(p);
      for (int i = 0; i < 40; ++i) {
        Corners corners;
        for (int k = 0; k < 3; ++k) {
          const double angle = sign * (2.0 * k + test::uniform(random, 0, 1)) * M_PI / 3.0;
          corners[k] = p + size * Vector3d(std::cos(angle), std::sin(angle), -height * test::uniform(random, 0.1, 1));
        }
        if (i % 8 == 7) std::swap(corners[0], corners[1]);
        for (const Vector3d& corner : corners) mesh.vertices.push_back(corner);
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
        sum.add(corners);
        ASSERT_NEAR(sum.value(), test::windingNumber(mesh, p), 1e-13 * (i + 1) / height) << size << " " << height;
      }
      EXPECT_GT(std::abs(sum.value()), 2.0);
    }
  }
}

}  // namespace sdf_ccd::triangle_tree_test
