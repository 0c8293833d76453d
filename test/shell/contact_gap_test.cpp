#include "shell/contact_gap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/infinity.h"
#include "mesh/triangle_tree.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "oracle/test_data.h"
#include "sdf_ccd/mesh.h"
#include "sdf_ccd/primitive.h"
#include "shell/flat_pieces.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::contact_gap_test {

constexpr double kGap = 0.02;

ShellOptions options(double gap = kGap) {
  ShellOptions options;
  options.spacing = 0.3;
  options.edge_gap = gap;
  return options;
}

struct Solid {
  TriangleMesh mesh;
  PointShell shell;
  TriangleTree tree;

  explicit Solid(const TriangleMesh& m) : mesh(m), shell(sampleSurface(m, options())), tree(m) {}
  /// The tessellation is so fine that it can replace the primitive.
  explicit Solid(const Primitive& p) : mesh(tessellate(p, 1e-5)), shell(sampleSurface(p, options())), tree(mesh) {}
};

Vector3d placeOn(const TriangleMesh& mesh, test::Random& random, bool on_edge) {
  const Vector3i& t = mesh.triangles[static_cast<std::size_t>(
      test::uniform(random, 0.0, static_cast<double>(mesh.triangles.size()) - 1e-6))];
  const double u = test::uniform(random, 0.0, 1.0), v = on_edge ? 0.0 : test::uniform(random, 0.0, 1.0 - u);
  const Vector3d &a = mesh.vertices[t[0]], &b = mesh.vertices[t[1]], &c = mesh.vertices[t[2]];
  return a + u * (b - a) + v * (c - a);
}

/// The smallest distance of the points of the first solid's shell from the second one's surface.
double nearest(const Solid& shell, const Isometry3d& X_FP, const Solid& field) {
  double best = kInfinity;
  for (const Vector3d& p : shell.shell.points()) best = field.tree.closestPoint(X_FP * p, best).distance;
  return best;
}

/// Lets the surfaces meet at random points: the largest distance that all points of both shells then keep.
double largestNearest(const Solid& a, const Solid& b, int trials) {
  test::Random random(7);
  double largest = 0.0;
  for (int i = 0; i < trials; ++i) {
    const Vector3d x_A = placeOn(a.mesh, random, i % 2), x_B = placeOn(b.mesh, random, i % 2);
    Isometry3d X_AB = test::pose(random, 3.0, 0.0);
    X_AB.translation() = x_A - X_AB.linear() * x_B;
    largest = std::max(largest, std::min(nearest(b, X_AB, a), nearest(a, X_AB.inverse(), b)));
  }
  return largest;
}

TEST(ContactGap, HoldsWhereverSurfacesMeet) {
  const Solid box(test::boxMesh({0.5, 0.3, 0.2})), plate(test::boxMesh({0.5, 0.5, 0.0005})),
      ball(test::icosphere(0.5, 2)), ring(test::torusMesh(0.4, 0.1, 40, 16)),
      cylinder(Primitive(Cylinder::fromRadiusAndLength(0.15, 0.8))), sphere(Primitive(Sphere{0.3}));
  const std::vector<const Solid*> solids = {&box, &plate, &ball, &ring, &cylinder, &sphere};
  for (const Solid* a : solids) {
    for (const Solid* b : solids) {
      const double gap = contactGap(a->shell, b->shell);
      EXPECT_LE(gap, kGap * (1 + 1e-9) + std::max(a->shell.position_error, b->shell.position_error));
      EXPECT_LE(largestNearest(*a, *b, 100), gap + 1e-5);
    }
  }
}

TEST(ContactGap, IsReachedWhereSharpEdgesCross) {
  const Solid plate(test::boxMesh({0.5, 0.5, 0.0005}));
  const double largest = largestNearest(plate, plate, 2000);
  EXPECT_LE(largest, contactGap(plate.shell, plate.shell));
  EXPECT_GE(largest, 0.5 * kGap);
}

TEST(ContactGap, NeedsFarFewerPointsThanFaces) {
  ShellOptions faces;
  faces.spacing = kGap;
  const TriangleMesh box = test::boxMesh({0.5, 0.3, 0.2});
  EXPECT_LT(20 * sampleSurface(box, options()).size(), 9 * sampleSurface(box, faces).size());
  ShellOptions fine = options(0.004);
  faces.spacing = 0.004;
  const Primitive sphere = Sphere{0.3}, bead = Sphere{0.02};
  for (const Primitive& curved : {sphere, bead}) {  // many edges: not many more points than for the whole surface
    EXPECT_LT(sampleSurface(curved, fine).size(), 1.5 * static_cast<double>(sampleSurface(curved, faces).size()));
  }
  // Twelve edges of eight metres in total, a point every 1.6 gaps, and a few points on faces.
  EXPECT_NEAR(static_cast<double>(sampleSurface(box, options()).size()), 8.0 / (1.6 * kGap), 60.0);
}

TEST(ContactGap, WithoutPointsOnEdgesAllOfASurfaceMustBeCovered) {
  const PointShell dense = sampleSurface(test::boxMesh({0.5, 0.3, 0.2}), options());
  const PointShell plain = sampleSurface(test::boxMesh({0.5, 0.3, 0.2}), options(0.0));
  EXPECT_EQ(contactGap(dense, plain), std::min(dense.covering_radius, plain.covering_radius));
  EXPECT_NEAR(contactGapToPlane(dense), 0.9 * kGap + dense.position_error, 1e-12);
  EXPECT_EQ(contactGapToPlane(plain), plain.covering_radius);
}

TEST(FlatPieces, ABoxHasTwelveEdges) {
  const TriangleMesh box = test::boxMesh({0.5, 0.3, 0.2});
  EXPECT_EQ(edgesOfFlatPieces(box, 1e-9).size(), 12u);
  TriangleMesh open = box;
  open.triangles.pop_back();
  EXPECT_EQ(edgesOfFlatPieces(open, 1e-9).size(), 13u);  // one is the diagonal, which is a border now
}

TEST(FlatPieces, BendBeyondTheFlatnessEndsAPiece) {
  const TriangleMesh ring = test::torusMesh(0.4, 0.1, 160, 64);
  const std::size_t all = edgesOfFlatPieces(ring, 0.0).size(), some = edgesOfFlatPieces(ring, 2e-3).size();
  EXPECT_GT(all, ring.triangles.size());
  EXPECT_LT(some, all / 2);
  EXPECT_GT(some, 100u);
}

TEST(ContactGap, HoldsOnRobotLinks) {
  SDF_CCD_NEEDS_DATA("robots/panda_description/meshes/collision/link5.stl");
  const TriangleMesh mesh = loadMesh(test::dataPath("robots/panda_description/meshes/collision/link5.stl"));
  ShellOptions fine;
  fine.spacing = 0.02;
  fine.edge_gap = 0.002;
  Solid link(mesh);
  link.shell = sampleSurface(mesh, fine);
  const double largest = largestNearest(link, link, 200);
  EXPECT_LE(largest, contactGap(link.shell, link.shell));
}

}  // namespace sdf_ccd::contact_gap_test
