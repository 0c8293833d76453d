// The orientation of parts, compared with solids that are known by construction.
#include <gtest/gtest.h>

#include "mesh/triangle_tree.h"
#include "oracle/drawn_meshes.h"
#include "oracle/random.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::mesh_orientation_test {

using test::boxMesh;
using test::boxOfDividedFaces;
using test::direction;
using test::flipped;
using test::icosphere;
using test::Random;
using test::translated;
using test::uniform;

bool isInside(const TriangleMesh& oriented, const Vector3d& p) {
  return TriangleTree(oriented).inside(p, TriangleTree::Inside::kNotZero);
}

TEST(MeshOrientation, AWebDrawnFromBothSidesStaysInAnOpenWheel) {
  const OrientedMesh wheel = orientOutward(test::wheelMesh(0.3, 0.1, 48));
  EXPECT_EQ(wheel.quality.wall_triangles, 96);
  EXPECT_EQ(wheel.quality.hidden_triangles, 0);
  EXPECT_EQ(wheel.quality.triangles, 4 * 48 + 96);
  EXPECT_FALSE(wheel.quality.sign_trusted);
  EXPECT_LT(TriangleTree(wheel.mesh).closestPoint({0.1, 0.01, 0.0}).distance, 1e-12);
}

TEST(MeshOrientation, AWallInsideASolidIsLeftOutAndSaid) {
  const TriangleMesh first = boxMesh({1, 1, 1}), second = translated(first, {2, 0, 0});
  const MeshQuality quality = orientOutward(merged(first, second)).quality;
  EXPECT_EQ(quality.triangles, 20);
  EXPECT_EQ(quality.hidden_triangles, 4);
  EXPECT_NEAR(quality.hidden_area, 8, 1e-12);
  EXPECT_TRUE(quality.sign_trusted);
  EXPECT_NE(summary(quality).find("4 triangles of interior walls removed (8 m^2)"), std::string::npos)
      << summary(quality);
  // If one is inside out, they may also have been drawn into each other: the common face then has the same orientation
  // in both.
  const OrientedMesh inverted = orientOutward(merged(first, flipped(second)));
  EXPECT_FALSE(inverted.quality.sign_trusted);
  for (const double x : {0.1, 2.1}) EXPECT_TRUE(isInside(inverted.mesh, {x, 0.2, 0.3}));
}

/// Which of two copies of a face in the same orientation belongs to which part must not make a part flip.
TriangleMesh block(const Vector3d& low, const Vector3d& high) {
  return translated(boxMesh(0.5 * (high - low)), 0.5 * (high + low));
}

TEST(MeshOrientation, PartsThatShareAFaceOneWithinTheOtherStayAsDrawn) {
  for (const double low : {0.5, -0.5}) {  // one shorter, or longer, from the same end
    const OrientedMesh result = orientOutward(merged(block({0, 0, 0}, {1, 1, 1}), block({0, 0, low}, {1, 1, 1})));
    EXPECT_TRUE(result.quality.sign_trusted) << low;
    EXPECT_TRUE(isInside(result.mesh, {0.4, 0.3, 0.75})) << low;
    EXPECT_TRUE(isInside(result.mesh, {0.4, 0.3, 0.25})) << low;
  }
}

/// The box with the other diagonal in the face whose triangles come first.
TriangleMesh likeButOneFace(TriangleMesh box) {
  const Vector3i a = box.triangles[0], b = box.triangles[1];
  const auto own = [](const Vector3i& of, const Vector3i& other) {
    for (int k = 0; k < 3; ++k)
      if ((other.array() != of[k]).all()) return k;
    return 0;
  };
  const int i = own(a, b), j = own(b, a);
  box.triangles[0] = {a[i], a[(i + 1) % 3], b[j]};
  box.triangles[1] = {b[j], b[(j + 1) % 3], a[i]};
  return box;
}

/// The mesh with its first triangles flipped.
TriangleMesh withTurned(TriangleMesh mesh, int count) {
  for (int i = 0; i < count; ++i) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  return mesh;
}

/// Parts that cancel within a patch, or that are filled though they may be cavities, are not trusted.
TEST(MeshOrientation, WhatMayCancelOrBeACavityIsDoubtful) {
  const TriangleMesh box = boxMesh({0.5, 0.5, 0.5}), cavity = boxMesh({0.3, 0.3, 0.3});
  TriangleMesh turned = flipped(box), half = flipped(box);  // mirrored: with the other diagonals
  for (Vector3d& v : turned.vertices) v.x() = -v.x();
  for (Vector3d& v : half.vertices) v = Vector3d(-v.x(), v.y(), 0.5 * v.z() + 0.25);
  const TriangleMesh apart = translated(box, {3, 0, 0});
  const std::pair<const char*, TriangleMesh> drawn[] = {
      {"a box and its inverted copy", merged(box, flipped(turned))},
      {"the same beside another", merged(merged(box, flipped(turned)), apart)},
      {"stacked, one inverted, and a third over it",
       merged(merged(box, flipped(translated(turned, {0, 0, 1}))), translated(boxMesh({0.3, 0.3, 0.3}), {0, 0, 1}))},
      {"a hollow part inside out beside a good one", merged(merged(flipped(box), cavity), apart)},
      {"a hull inside out around a cavity", merged(flipped(box), flipped(cavity))},
      {"a hull twice, a cavity once", merged(merged(box, turned), flipped(cavity))},
      {"a part that shares edges with the hull", merged(merged(box, flipped(cavity)), half)},
      {"a cavity and what fills it, alike", merged(merged(box, flipped(cavity)), cavity)},
      {"the same the other way round", merged(merged(cavity, flipped(cavity)), box)},
      {"a box and an inverted copy, in part alike", merged(box, flipped(likeButOneFace(box)))},
      {"a cavity of which half the faces are turned", merged(box, withTurned(flipped(cavity), 6))},
      {"a hull inside out around a cavity, beside a box", merged(merged(flipped(box), flipped(cavity)), apart)},
      {"a hull twice, alike, and a cavity", merged(merged(box, box), flipped(cavity))},
      {"a box, and in its end an inverted one",
       merged(block({0, 0, 0}, {0.25, 0.25, 0.25}), flipped(block({0, 0, 0}, {0.25, 0.25, 0.5})))},
      {"an arm over an inverted lobe of its own", test::armOverItsLobe()},
  };
  for (const auto& [name, mesh] : drawn) EXPECT_FALSE(orientOutward(mesh).quality.sign_trusted) << name;
}

TEST(MeshOrientation, AWallAcrossARingStays) {
  // A square ring of four prisms as one surface, its hole closed by a sheet from both sides on the inner edges.
  TriangleMesh ring;
  for (const double half : {1.0, 0.5}) {
    for (const double z : {-0.2, 0.2}) {
      for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        ring.vertices.emplace_back(half * x, half * y, z);
    }
  }
  const auto quad = [&](int a, int b, int c, int d) {
    ring.triangles.emplace_back(a, b, c);
    ring.triangles.emplace_back(a, c, d);
  };
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    quad(i, j, 4 + j, 4 + i);
    quad(8 + j, 8 + i, 12 + i, 12 + j);
    quad(4 + i, 4 + j, 12 + j, 12 + i);
    quad(j, i, 8 + i, 8 + j);
  }
  quad(12, 13, 14, 15);
  quad(12, 15, 14, 13);
  for (const TriangleMesh& drawn : {ring, flipped(ring)}) {
    const OrientedMesh result = orientOutward(drawn);
    EXPECT_EQ(result.quality.wall_triangles, 4);
    // A part that is inside out, and shares a face with another, leaves such walls too.
    EXPECT_FALSE(result.quality.sign_trusted) << summary(result.quality);
    EXPECT_TRUE(isInside(result.mesh, {0.75, 0.1, 0.1}));
    EXPECT_FALSE(isInside(result.mesh, {0.1, 0.05, 0.1}));
    EXPECT_LT(TriangleTree(result.mesh).closestPoint({0.1, 0.05, 0.2}).distance, 1e-12);
  }
}

TEST(MeshOrientation, TheShelfOfAnOpenCupboardIsTurnedAndSaid) {
  const test::Cupboard cupboard;
  const OrientedMesh as_drawn = orientOutward(merged(cupboard.walls, cupboard.shelf));
  EXPECT_EQ(as_drawn.quality.inverted_components, 0);
  EXPECT_EQ(as_drawn.quality.inverted_sheets, 0);
  const OrientedMesh turned = orientOutward(merged(cupboard.walls, flipped(cupboard.shelf)));
  EXPECT_EQ(turned.quality.inverted_components, 1);
  EXPECT_NEAR(turned.quality.volume, as_drawn.quality.volume, 1e-12);
  EXPECT_FALSE(turned.quality.sign_trusted);
  EXPECT_EQ(warningOf(turned.quality),
            "inside and outside are uncertain; 1 component was inside out and has been flipped");
}

TEST(MeshOrientation, OpenPartsAreTurnedForWhatSeesThem) {
  const test::Cupboard cupboard;
  for (const double size : {1e-6, 1.0, 1e5}) {
    for (const Vector3d& offset : {Vector3d(0, 0, 0), Vector3d(3, -2, 1), Vector3d(1e3, 2e3, -1e3)}) {
      const Isometry3d X(Eigen::Translation3d(offset * size) * Eigen::AngleAxisd(offset.norm(), Vector3d(0.6, 0, 0.8)));
      const TriangleMesh walls = transformed(scaled(cupboard.walls, Vector3d::Constant(size)), X);
      for (const TriangleMesh& drawn : {walls, flipped(walls)}) {
        const TriangleTree tree(orientOutward(drawn).mesh);
        EXPECT_GT(tree.windingNumber(X * (size * Vector3d(0.1, -0.6, 0.2))), 0.5) << size << " at " << offset.x();
        EXPECT_LT(tree.windingNumber(X * (size * Vector3d(0.1, 0.2, 0.2))), 0.5) << size << " at " << offset.x();
      }
    }
  }
}

/// Rays from faces inside the other box meet its back: such faces used to be flipped, and the inside counted as
/// outside.
TEST(MeshOrientation, FacesOfBoxesThatOverlapStayAsDrawnThoughTheirEdgesDoNotMeet) {
  Random random(7);
  for (int i = 0; i < 50; ++i) {
    const Vector3d half_a(uniform(random, 0.05, 0.5), uniform(random, 0.05, 0.5), uniform(random, 0.05, 0.5));
    const Vector3d half_b(uniform(random, 0.05, 0.5), uniform(random, 0.05, 0.5), uniform(random, 0.05, 0.5));
    const Vector3d offset = uniform(random, 0.0, 0.4) * direction(random);
    const TriangleMesh drawn = merged(boxOfDividedFaces(half_a), translated(boxOfDividedFaces(half_b), offset));
    const OrientedMesh oriented = orientOutward(drawn);
    EXPECT_EQ(oriented.quality.inverted_sheets, 0) << i;
    EXPECT_TRUE(oriented.quality.sign_trusted) << i;
    EXPECT_NEAR(oriented.quality.volume, 8.0 * (half_a.prod() + half_b.prod()), 1e-9) << i;
  }
}

/// Closed parts are recognised though their edges do not meet, so that cavities are distinguished from inverted parts;
/// also if corners are rounded to floats, if those of each face differ in the last digits, and if triangles without
/// height fill the seams.
TEST(MeshOrientation, BoxesOfDividedFacesAreTurnedAsClosedOnes) {
  const TriangleMesh shell = merged(boxOfDividedFaces({0.4, 0.3, 0.2}), flipped(boxOfDividedFaces({0.3, 0.2, 0.1})));
  const TriangleMesh drawn = merged(shell, flipped(translated(boxOfDividedFaces({0.2, 0.2, 0.2}), {-0.55, 0.1, 0.05})));
  TriangleMesh as_floats = drawn, with_seams = drawn, last_bits = drawn, last_floats = drawn;
  for (Vector3d& v : as_floats.vertices) v = v.cast<float>().cast<double>();
  Random random(8);
  for (Vector3d& v : last_bits.vertices) v += 4e-16 * direction(random);
  for (Vector3d& v : last_floats.vertices) v += 4e-8 * direction(random);
  const int first = static_cast<int>(with_seams.vertices.size());
  for (const double x : {-0.4, 0.1, 0.4}) with_seams.vertices.emplace_back(x, -0.3, -0.2);
  with_seams.triangles.emplace_back(first, first + 1, first + 2);
  for (const auto& [name, mesh] :
       {std::pair("doubles", drawn), std::pair("floats", as_floats), std::pair("seams", with_seams),
        std::pair("last bits", last_bits), std::pair("last bits of floats", last_floats)}) {
    SCOPED_TRACE(name);
    const OrientedMesh oriented = orientOutward(mesh);
    EXPECT_FALSE(oriented.quality.sign_trusted);  // as one of several is turned
    EXPECT_EQ(oriented.quality.inverted_components, 1);
    EXPECT_EQ(oriented.quality.inverted_sheets, 0);
    EXPECT_TRUE(isInside(oriented.mesh, {0.35, 0.01, 0.02}));
    EXPECT_TRUE(isInside(oriented.mesh, {-0.6, 0.15, 0.07}));
    EXPECT_FALSE(isInside(oriented.mesh, {0.01, 0.02, 0.03}));
  }
}

TEST(MeshOrientation, AHollowBoxOfWallsOfNearlyNoThicknessKeepsItsCavity) {
  for (const double wall : {1e-5, 5e-7, 1e-9}) {
    const TriangleMesh box = boxMesh({0.5, 0.5, 0.5}), cavity = boxMesh(Vector3d::Constant(0.5 - wall));
    const OrientedMesh hollow = orientOutward(merged(box, flipped(cavity)));
    EXPECT_EQ(hollow.quality.inverted_components, 0) << wall;
    EXPECT_EQ(hollow.quality.sign_trusted, wall > 1e-6) << wall;  // else within rounding of floats
    EXPECT_FALSE(isInside(hollow.mesh, {0.1, 0.2, 0.05})) << wall;
  }
}

/// A block with every face divided into thin triangles about a point of its own, whose edges meet those of other faces
/// only at corners.
TriangleMesh fanned(const Vector3d& low, const Vector3d& high, double at) {
  TriangleMesh mesh = block(low, high);
  std::vector<Vector3i> fans;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
    const Vector3i a = mesh.triangles[i], b = mesh.triangles[i + 1];
    const int corners[] = {a[0], a[1], a[2], b[2]}, middle = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back((1.0 - at) * mesh.vertices[a[0]] + at * mesh.vertices[a[2]]);
    for (int k = 0; k < 4; ++k) fans.emplace_back(corners[k], corners[(k + 1) % 4], middle);
  }
  mesh.triangles = fans;
  return mesh;
}

/// Which part of the space is solid depends on which of the two is assumed to be drawn wrongly.
TEST(MeshOrientation, APartInsideOutThatIsFlushInTheCornerOfAnotherIsDoubtful) {
  for (const bool outer_inverted : {false, true}) {
    for (int axis = 0; axis < 8; ++axis) {
      const Vector3d corner((axis & 1) != 0, (axis & 2) != 0, (axis & 4) != 0), size(0.5, 0.625, 0.375);
      const Vector3d low = corner.cwiseProduct(Vector3d::Ones() - size);
      for (const double gap : {0.0, 3e-8}) {  // as rounding of floats leaves it
        const Vector3d inward = gap * (Vector3d::Ones() - 2.0 * corner);
        const TriangleMesh outer = fanned({0, 0, 0}, {1, 1, 1}, 0.375);
        const TriangleMesh inner = fanned(low + inward, low + size + inward, 0.625);
        const OrientedMesh result =
            orientOutward(outer_inverted ? merged(flipped(outer), inner) : merged(outer, flipped(inner)));
        EXPECT_FALSE(result.quality.sign_trusted) << axis << " " << outer_inverted << " " << gap;
      }
    }
  }
}

/// Faces of one box that are divided at corners of the other are joined over edges of both, to one surface: like that
/// of the rest of the outer box, inside out. A bead in the inner box used to be CLEAR.
TEST(MeshOrientation, PartsLinkedWhereTheirFacesMeetAreDoubtfulIfTheyAreTurned) {
  // clang-format off
  const TriangleMesh mesh{
      {{0, 0, 0}, {0, 1, 1}, {0, 0, 1}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}, {1, 1, 0}, {1, 0, 1}, {0.75, 0, 0.375},
       {0, 0.75, 0}, {1, 0.75, 0}, {0.75, 0.25, 1}, {0.25, 0, 0}, {0.25, 0, 0.75}, {0.25, 0.75, 0}, {0.25, 0.75, 0.75},
       {1, 0.375, 0}, {1, 0.375, 0.75}, {1, 0, 0.75}, {1, 0.65625, 0}, {1, 0.65625, 0.75}, {1, 0.75, 0.75}},
      {{0, 1, 2}, {0, 3, 1}, {4, 5, 6}, {4, 7, 5}, {0, 8, 4}, {4, 8, 7}, {7, 8, 2}, {2, 8, 0}, {3, 5, 1}, {3, 6, 5},
       {0, 4, 9}, {9, 4, 10}, {9, 10, 3}, {3, 10, 6}, {2, 11, 7}, {7, 11, 5}, {5, 11, 1}, {1, 11, 2}, {12, 13, 14},
       {13, 15, 14}, {4, 16, 17}, {4, 17, 18}, {16, 19, 20}, {16, 20, 17}, {19, 10, 20}, {10, 21, 20}, {12, 4, 13},
       {4, 18, 13}, {14, 15, 21}, {14, 21, 10}, {12, 14, 10}, {12, 10, 4}, {13, 18, 15}, {18, 21, 15}}};
  // clang-format on
  EXPECT_FALSE(orientOutward(mesh).quality.sign_trusted);
}

TEST(MeshOrientation, AFileInsideOutKeepsItsCavities) {
  const TriangleMesh hollow = merged(boxMesh({1, 1, 1}), flipped(icosphere(0.5, 2)));
  const TriangleMesh two = merged(hollow, translated(boxMesh({1, 1, 1}), {4, 0, 0}));
  for (const TriangleMesh& mesh : {hollow, two}) {
    const OrientedMesh result = orientOutward(flipped(mesh));
    EXPECT_FALSE(isInside(result.mesh, {0, 0, 0}));
    EXPECT_TRUE(isInside(result.mesh, {0.8, 0.8, 0.8}));
    EXPECT_FALSE(result.quality.sign_trusted);  // maybe the block alone is inverted, and the ball solid
  }
}

/// The part contains the block's outermost corners on its side, so that the block seems to lie in it.
TEST(MeshOrientation, APartInsideOutAcrossTheEndOfABlockLeavesItsCavity) {
  const TriangleMesh hollow = merged(boxMesh({0.4, 0.3, 0.2}), flipped(boxMesh({0.3, 0.2, 0.1})));
  for (const double x : {0.55, -0.55}) {
    const TriangleMesh part = flipped(translated(boxMesh({0.2, 0.2, 0.2}), {x, 0.1, 0.05}));
    const TriangleMesh hood = flipped(translated(boxMesh({0.2, 0.35, 0.25}), {x, 0.0, 0.0}));  // around the whole end
    for (const TriangleMesh& across : {part, hood}) {
      const OrientedMesh result = orientOutward(merged(hollow, across));
      EXPECT_EQ(result.quality.inverted_components, 1) << x;
      EXPECT_FALSE(isInside(result.mesh, {0.01, 0.02, 0.03})) << x;
      EXPECT_TRUE(isInside(result.mesh, {0.35, 0.01, 0.02})) << x;
      EXPECT_FALSE(result.quality.sign_trusted) << x;
    }
  }
}

TEST(MeshOrientation, ABallInACavityIsNoCavity) {
  const TriangleMesh hollow = merged(boxMesh({1, 1, 1}), flipped(icosphere(0.8, 2)));
  const TriangleMesh ball = icosphere(0.3, 2);
  for (const TriangleMesh& inner : {ball, flipped(ball)}) {
    const OrientedMesh result = orientOutward(merged(hollow, inner));
    EXPECT_TRUE(isInside(result.mesh, {0, 0, 0}));
    EXPECT_FALSE(isInside(result.mesh, {0.5, 0, 0}));
    EXPECT_TRUE(isInside(result.mesh, {0.95, 0, 0}));
  }
}

TEST(MeshOrientation, ACavityThatCutsOrTouchesWhatHoldsItIsFilled) {
  const TriangleMesh block = boxMesh({1, 1, 1});
  for (const double z : {0.5, 0.7}) {  // its top face on the block's, and outside
    const TriangleMesh pocket = flipped(translated(boxMesh({0.5, 0.4, 0.5}), {0, 0, z}));
    const OrientedMesh result = orientOutward(merged(block, pocket));
    EXPECT_EQ(result.quality.inverted_components, 1);
    EXPECT_TRUE(isInside(result.mesh, {0.1, 0.05, 0.6}));
  }
}

TEST(MeshOrientation, LobesOfABowTieAreCountedAndDoubtedInOtherParts) {
  const TriangleMesh tie = test::bowTieMesh();
  const OrientedMesh alone = orientOutward(tie);
  EXPECT_GT(alone.quality.negative_triangles, 96);
  EXPECT_TRUE(alone.quality.sign_trusted);
  EXPECT_NE(warningOf(alone.quality).find("inside out"), std::string::npos);
  const auto box_at = [&](const Vector3d& p, double half) { return translated(boxMesh(Vector3d::Constant(half)), p); };
  // In the ring, around it, across its surface, and in the rod, some winding numbers cancel.
  for (const auto& [x, half] : {std::pair(0.126, 0.01), {0.126, 0.3}, {0.126, 0.04}, {0.001, 0.01}, {0.001, 0.04}}) {
    const OrientedMesh both = orientOutward(merged(tie, box_at({x, 0.001, 0.1 * (x < 0.1)}, half)));
    EXPECT_FALSE(both.quality.sign_trusted) << x << " " << half;
  }
}

TEST(MeshOrientation, TheAnswerIsTheSameEachTime) {
  const test::Cupboard cupboard;
  const TriangleMesh mesh = merged(flipped(cupboard.walls), cupboard.shelf);
  const TriangleMesh first = orientOutward(mesh).mesh;
  for (int i = 0; i < 5; ++i) EXPECT_EQ(orientOutward(mesh).mesh.triangles, first.triangles);
}

}  // namespace sdf_ccd::mesh_orientation_test
