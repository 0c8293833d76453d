// The orientation of parts of many random meshes, compared with solids that are known by construction.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/triangle_tree.h"
#include "oracle/drawn_meshes.h"
#include "oracle/random.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::random_orientation_test {

using test::boxMesh;
using test::flipped;
using test::icosphere;
using test::translated;

/// A box or a sphere, possibly hollow, that may overlap others.
struct Body {
  bool ball = false;
  Vector3d center, half;
  double cavity = 0.0;  ///< radius; 0 for none

  TriangleMesh mesh(bool inverted) const {
    TriangleMesh skin = translated(ball ? icosphere(half.x(), 2) : boxMesh(half), center);
    if (inverted) skin = flipped(skin);
    return cavity > 0 ? merged(skin, flipped(translated(icosphere(cavity, 1), center))) : skin;
  }

  /// 1 inside, 0 outside, -1 too near to a faceted sphere to decide.
  int side(const Vector3d& p) const {
    const Vector3d r = p - center;
    const auto in_ball = [&](double radius) { return r.norm() > radius ? 0 : r.norm() < 0.85 * radius ? 1 : -1; };
    const int skin = ball ? in_ball(half.x()) : (r.cwiseAbs().array() < half.array()).all();
    if (skin != 1 || cavity == 0.0) return skin;
    const int hole = in_ball(cavity);
    return hole < 0 ? -1 : 1 - hole;
  }

  /// Whether another body's surface may lie inside this one: then it could be taken for a cavity.
  bool mayHold(const Body& other) const {
    return ((other.center - center).cwiseAbs().array() + other.half.array() < half.array() + 1e-9).all();
  }
};

TEST(RandomOrientation, SoupsOfSolidsTurnedAtRandomAreTheirUnion) {
  test::Random random(5);
  int turned = 0, places = 0;
  for (int soup = 0; soup < 150; ++soup) {
    std::vector<Body> bodies;
    const int count = 2 + static_cast<int>(random() % 5);
    for (int i = 0; i < count; ++i) {
      Body body;
      body.ball = random() % 2 == 0;
      body.center = test::uniformIn(random, {Vector3d::Constant(-1), Vector3d::Constant(1)});
      for (int k = 0; k < 3; ++k) body.half[k] = test::uniform(random, 0.2, 0.8);
      if (body.ball) body.half.setConstant(body.half.x());
      if (random() % 3 == 0) body.cavity = test::uniform(random, 0.2, 0.6) * body.half.minCoeff();
      const bool nested =
          std::any_of(bodies.begin(), bodies.end(), [&](const Body& b) { return b.mayHold(body) || body.mayHold(b); });
      if (!nested) bodies.push_back(body);
    }
    // The first is as it should be, wherever it lies among the others: the file is not inside out as a whole.
    TriangleMesh mesh = bodies[0].mesh(false);
    int inverted = 0;
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const bool invert = random() % 2 == 0;
      inverted += invert;
      mesh = merged(mesh, bodies[i].mesh(invert));
    }
    // Cavities may cut each other's: then the number is below zero there, and the sign is not trusted.
    const OrientedMesh result = orientOutward(mesh);
    EXPECT_EQ(result.quality.inverted_components, inverted) << "soup " << soup;
    turned += inverted;
    const TriangleTree tree(result.mesh);
    for (int i = 0; i < 200; ++i) {
      const Vector3d p = test::uniformIn(random, {Vector3d::Constant(-1.6), Vector3d::Constant(1.6)});
      int truth = 0;
      for (const Body& body : bodies) {
        const int side = body.side(p);
        if (side != 0 && truth <= 0) truth = side;
        if (side == 1) truth = 1;
      }
      if (truth < 0) continue;
      ++places;
      ASSERT_EQ(tree.inside(p, TriangleTree::Inside::kNotZero), truth == 1)
          << "soup " << soup << " at " << p.transpose();
    }
  }
  EXPECT_GT(turned, 200);
  EXPECT_GT(places, 20000);
}

TEST(RandomOrientation, OpenBoxesTurnedAtRandomAreTurnedOutward) {
  test::Random random(6);
  for (int soup = 0; soup < 40; ++soup) {
    TriangleMesh mesh;
    double volume = 0.0;
    int inverted = 0;
    for (int i = 0; i < 12; ++i) {
      const Vector3d low(1.2 * (i % 3), 1.2 * (i / 3 % 2), 1.2 * (i / 6));
      TriangleMesh box = test::openBox(low, low + Vector3d(1, test::uniform(random, 0.3, 1.1), 1));
      const Isometry3d X = test::pose(random, 3.0, 0.0);
      const Vector3d center = boundingBox(box).center();
      box = transformed(box, Eigen::Translation3d(1.6 * center) * X * Eigen::Translation3d(-center));
      volume += signedVolume(box);
      const bool invert = random() % 2 == 0;
      inverted += invert;
      mesh = merged(mesh, invert ? flipped(box) : box);
    }
    const OrientedMesh result = orientOutward(mesh);
    EXPECT_EQ(result.quality.inverted_sheets, inverted) << "soup " << soup;
  }
}

TEST(RandomOrientation, AnyTrianglesOnAGridAreTaken) {
  // Duplicates, degenerate and overlapping triangles, many on an edge.
  test::Random random(7);
  for (int i = 0; i < 400; ++i) {
    TriangleMesh mesh;
    const int side = 2 + static_cast<int>(random() % 2), vertices = side * side * side;
    const double scale = std::pow(10.0, test::uniform(random, -8, 5));
    for (int v = 0; v < vertices; ++v) mesh.vertices.emplace_back(v % side, v / side % side, v / (side * side));
    for (Vector3d& v : mesh.vertices) v = scale * (v + Vector3d(0, 0, 1e3 * (i % 2)));
    const int triangles = 1 + static_cast<int>(random() % 60);
    for (int t = 0; t < triangles; ++t) {
      mesh.triangles.emplace_back(random() % vertices, random() % vertices, random() % vertices);
    }
    if (welded(mesh).triangles.empty()) continue;
    const OrientedMesh result = orientOutward(mesh);
    const MeshQuality& quality = result.quality;
    EXPECT_TRUE(!quality.sign_trusted || isClosed(result.mesh));
    EXPECT_EQ(quality.triangles + quality.duplicate_triangles + quality.hidden_triangles,
              static_cast<int>(welded(mesh).triangles.size()));
    EXPECT_TRUE(std::isfinite(quality.volume) && std::isfinite(quality.area));
    // Triangles that are left out lie on or inside those that are kept.
    const TriangleTree tree(result.mesh);
    for (const Vector3i& t : welded(mesh).triangles) {
      const TriangleMesh weld = welded(mesh);
      const Vector3d center = (weld.vertices[t[0]] + weld.vertices[t[1]] + weld.vertices[t[2]]) / 3.0;
      const double distance = tree.closestPoint(center).distance;
      EXPECT_TRUE(distance < 1e-9 * scale || tree.inside(center, TriangleTree::Inside::kNotZero)) << "mesh " << i;
    }
  }
}

}  // namespace sdf_ccd::random_orientation_test
