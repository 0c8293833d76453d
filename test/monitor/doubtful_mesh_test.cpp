// Closed meshes whose inside cannot be determined: only surfaces decide.
#include <algorithm>
#include <optional>

#include <gtest/gtest.h>

#include "oracle/drawn_meshes.h"
#include "oracle/open_shapes.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "sdf_ccd/mesh.h"

namespace sdf_ccd::doubtful_mesh_test {

using test::boxMesh;
using test::flipped;
using test::Shape;
using test::translated;
using test::translation;

/// Verdict of a small box that moves from `start` to `end` in the mesh's frame.
Verdict verdictOf(const TriangleMesh& mesh, const Vector3d& start, const Vector3d& end) {
  const auto scene = test::build(
      {test::body("bead", Primitive(Box::fromSize({0.04, 0.04, 0.04}))), test::body("part", test::meshShape(mesh))},
      test::fine(0.02));
  Monitor monitor(scene, test::soft());
  return monitor
      .run(test::cycle(0.1, {{translation(start), translation(end)}, test::still(Isometry3d::Identity())}), {})
      .pairs.front()
      .verdict;
}

/// A box with the opposite diagonals of boxMesh().
TriangleMesh mirroredBox(const Vector3d& half_size) {
  TriangleMesh mesh = flipped(boxMesh(half_size));
  for (Vector3d& v : mesh.vertices) v.x() = -v.x();
  return mesh;
}

TriangleMesh block(const Vector3d& low, const Vector3d& high) {
  return translated(boxMesh(0.5 * (high - low)), 0.5 * (high + low));
}

TEST(DoubtfulMesh, WhatIsInsideIsNeverClear) {
  const TriangleMesh box = boxMesh({0.3, 0.3, 0.3});
  const TriangleMesh sheets = merged(box, flipped(mirroredBox({0.3, 0.3, 0.3})));
  const TriangleMesh stacked = merged(merged(box, flipped(translated(mirroredBox({0.3, 0.3, 0.3}), {0, 0, 0.6}))),
                                      translated(boxMesh({0.2, 0.2, 0.2}), {0, 0, 0.6}));
  EXPECT_EQ(verdictOf(sheets, {0, 0, 0}, {0.01, 0, 0}), Verdict::kUncertain);
  EXPECT_EQ(verdictOf(stacked, {0, 0, 0.6}, {0.01, 0, 0.6}), Verdict::kUncertain);
  for (const TriangleMesh& mesh : {sheets, stacked}) {
    EXPECT_EQ(verdictOf(mesh, {0.4, 0, 0}, {0.4, 0.1, 0}), Verdict::kClear);
    EXPECT_EQ(verdictOf(mesh, {0.4, 0, 0}, {0.2, 0, 0}), Verdict::kContact);
    EXPECT_EQ(verdictOf(mesh, {0.3, 0, 0}, {0.3, 0, 0}), Verdict::kContact);
  }
}

/// A block of two halves with a slit between them, along whose edges tiny triangles lie like stepping stones, each
/// within rounding of the next: the slit is open, though vertices follow one another across it.
TriangleMesh slitBlock(double slit, const Vector3d& center) {
  TriangleMesh mesh;
  const auto addHalf = [&](double low, double high, int open_side) {
    TriangleMesh half = block({low, -0.5, -0.5}, {high, 0.5, 0.5});
    const auto is_open = [&](const Vector3i& t) {
      const Vector3d center = (half.vertices[t[0]] + half.vertices[t[1]] + half.vertices[t[2]]) / 3.0;
      return open_side * (center.x() - 0.5 * (low + high)) > 0.49 * (high - low);
    };
    half.triangles.erase(std::remove_if(half.triangles.begin(), half.triangles.end(), is_open), half.triangles.end());
    EXPECT_EQ(half.triangles.size(), 10u);
    mesh = mesh.triangles.empty() ? half : merged(mesh, half);
  };
  addHalf(-0.5, -0.5 * slit, 1);
  for (int corner = 0; corner < 4; ++corner) {
    const Vector3d start(-0.5 * slit, corner & 1 ? 0.5 : -0.5, corner & 2 ? 0.5 : -0.5);
    TriangleMesh stones;
    for (double x = 0.8e-6; x < slit; x += 0.8e-6) {
      const int first = static_cast<int>(stones.vertices.size());
      for (const Vector3d& to : {Vector3d(0, 0, 0), Vector3d(1e-7, 1e-7, 0), Vector3d(1e-7, 0, 1e-7)})
        stones.vertices.push_back(start + Vector3d(x, 0, 0) + to);
      stones.triangles.emplace_back(first, first + 1, first + 2);
    }
    mesh = merged(mesh, stones);
  }
  addHalf(0.5 * slit, 0.5, -1);
  return translated(mesh, center);
}

TEST(DoubtfulMesh, SteppingStonesCloseNoSlit) {
  const double slit = 2e-4;
  const TriangleMesh mesh = slitBlock(slit, {10, 0, 0});
  EXPECT_FALSE(orientOutward(mesh).quality.sign_trusted);
  // Wholly inside, a corner under the slit, nearer to the upper face than what fields can tell.
  const Vector3d under(10.02, 0, 0.5 - slit - 0.02);
  EXPECT_NE(verdictOf(mesh, under, under), Verdict::kClear);
}

TEST(DoubtfulMesh, WhatIsInACavityThatMayBeFilledIsNoContact) {
  const TriangleMesh box = boxMesh({0.3, 0.3, 0.3}), cavity = boxMesh({0.2, 0.2, 0.2});
  TriangleMesh open = box;
  open.triangles.pop_back();
  for (const TriangleMesh& mesh :
       {merged(open, flipped(cavity)), merged(merged(box, mirroredBox({0.3, 0.3, 0.3})), flipped(cavity)),
        merged(merged(flipped(box), cavity), translated(box, {2, 0, 0})), merged(flipped(box), flipped(cavity))}) {
    EXPECT_EQ(verdictOf(mesh, {0, 0, 0}, {0.01, 0, 0}), Verdict::kUncertain);
    EXPECT_EQ(verdictOf(mesh, {0, 0, 0}, {0.2, 0, 0}), Verdict::kContact);
  }
}

/// Faces that do not quite meet are no closed component, in which the cavity would be known as one.
TEST(DoubtfulMesh, WhatIsInACavityOfACrackedHousingIsNoContact) {
  for (const double crack : {1e-5, 1e-4, 1e-3, 1e-2}) {
    TriangleMesh housing;
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        const TriangleMesh face =
            test::without(boxMesh({1, 1, 1}), [&](const Vector3d& p) { return side * p[axis] < 0.99; });
        Vector3d scale = Vector3d::Constant(1.0 - crack);
        scale[axis] = 1.0;
        TriangleMesh smaller = face;
        for (Vector3d& v : smaller.vertices) v = v.cwiseProduct(scale);
        housing = merged(std::move(housing), smaller);
      }
    const TriangleMesh mesh = merged(housing, flipped(boxMesh({0.8, 0.8, 0.8})));
    EXPECT_EQ(verdictOf(mesh, {0, 0, 0}, {0.01, 0, 0}), Verdict::kUncertain) << crack;
    EXPECT_EQ(verdictOf(mesh, {0, 0, 0}, {0.81, 0, 0}), Verdict::kContact) << crack;
    EXPECT_EQ(verdictOf(mesh, {1.1, 0, 0}, {1.1, 0, 0.5}), Verdict::kClear) << crack;
  }
}

/// Deep in a tube that may be filled a bead sees nothing outside; on its way out it is CLEAR at most a tenth of its
/// size later than if nothing were kept from earlier cycles.
TEST(DoubtfulMesh, WhatComesOutOfATubeBecomesClear) {
  const TriangleMesh tube = test::without(boxMesh({0.03, 0.03, 0.2}), [](const Vector3d& p) { return p.z() > 0.19; });
  const TriangleMesh sheets = merged(boxMesh({0.3, 0.3, 0.3}), flipped(mirroredBox({0.3, 0.3, 0.3})));
  const auto scene = test::build({test::body("bead", Primitive(Box::fromSize({0.04, 0.04, 0.04}))),
                                  test::body("part", test::meshShape(merged(tube, translated(sheets, {2, 0, 0}))))},
                                 test::fine(0.02));
  ASSERT_TRUE(scene->bodies[1].doubtful);
  Monitor kept(scene, test::soft()), fresh(scene, test::soft());
  constexpr double kStep = 0.002;
  int first_kept = -1, first_fresh = -1;
  for (int i = 0; i < 200; ++i) {
    const Vector3d start(0, 0, -0.1 + kStep * i), end(0, 0, -0.1 + kStep * (i + 1));
    const CycleMotion motion =
        test::cycle(0.01, {{translation(start), translation(end)}, test::still(Isometry3d::Identity())});
    fresh.reset();
    const auto look = [&](Monitor& monitor, int& first) {
      const Verdict verdict = monitor.run(motion, {}).pairs.front().verdict;
      EXPECT_EQ(verdict, first < 0 && verdict != Verdict::kClear ? Verdict::kUncertain : Verdict::kClear) << i;
      if (first < 0 && verdict == Verdict::kClear) first = i;
    };
    look(kept, first_kept);
    look(fresh, first_fresh);
  }
  EXPECT_GT(first_fresh, 0);
  EXPECT_GE(first_kept, first_fresh);
  EXPECT_LE((first_kept - first_fresh) * kStep, 0.1 * 0.035 + kStep);
}

/// No box is inside out, but they are tessellated separately and a loose sheet keeps the mesh open, so the orientation
/// of their faces is a guess.
TEST(DoubtfulMesh, WhatIsInPartsBesideALooseSheetIsNotClear) {
  struct Case {
    Vector3d first, second, offset, place;
  };
  const TriangleMesh sheet{{{1, 0, 0}, {1, 0.1, 0}, {1, 0, 0.1}}, {{0, 1, 2}}};
  for (const auto& [first, second, offset, place] :
       {Case{{0.2, 0.1, 0.1}, {0.3, 0.3, 0.2}, {-0.1, 0.1, 0}, {0.0957, 0.0208, 0.0369}},
        Case{{0.1, 0.3, 0.1}, {0.2, 0.3, 0.3}, {0.1, 0, 0}, {-0.0625, -0.0207, 0.0543}},
        Case{{0.3, 0.3, 0.3}, {0.1, 0.3, 0.1}, {0.1, -0.1, 0}, {0.147, -0.1018, -0.0052}}}) {
    const TriangleMesh boxes =
        merged(test::boxOfDividedFaces(first), translated(test::boxOfDividedFaces(second), offset));
    const TriangleMesh mesh = merged(boxes, sheet);
    EXPECT_NE(verdictOf(mesh, place, place), Verdict::kClear);
    EXPECT_EQ(verdictOf(mesh, {0.7, 0, 0}, {0.7, 0, 0.1}), Verdict::kClear);
    EXPECT_EQ(verdictOf(mesh, {1, 0.02, 0}, {1, 0.02, 0.01}), Verdict::kContact);
    EXPECT_EQ(verdictOf(boxes, place, place), Verdict::kContact);
  }
}

TEST(DoubtfulMesh, BoxesThatShareAnEndAreNotDoubtful) {
  const TriangleMesh mesh = merged(block({0, 0, 0}, {0.5, 0.5, 0.5}), block({0, 0, 0.25}, {0.5, 0.5, 0.5}));
  EXPECT_EQ(verdictOf(mesh, {0.2, 0.2, 0.4}, {0.21, 0.2, 0.4}), Verdict::kContact);
  EXPECT_EQ(verdictOf(mesh, {0.2, 0.2, 0.1}, {0.21, 0.2, 0.1}), Verdict::kContact);
  EXPECT_EQ(verdictOf(mesh, {0.2, 0.2, 0.6}, {0.21, 0.2, 0.6}), Verdict::kClear);
}

TEST(DoubtfulMesh, AHullOfFacesThatMeetButForTheLastDigitsHasItsCavity) {
  test::Random random(3);
  TriangleMesh hull = test::boxOfDividedFaces({0.4, 0.3, 0.3});
  for (Vector3d& v : hull.vertices) v += 4e-16 * test::direction(random);
  const TriangleMesh mesh = merged(hull, flipped(boxMesh({0.2, 0.2, 0.2})));
  EXPECT_EQ(verdictOf(mesh, {0, 0, 0}, {0.01, 0, 0}), Verdict::kClear);
  EXPECT_EQ(verdictOf(mesh, {0.25, 0.25, 0}, {0.251, 0.25, 0}), Verdict::kContact);
}

/// A link with a doubtful mesh, and optionally another element.
BodyDescription doubtfulLink(const std::optional<Shape>& beside) {
  const TriangleMesh sheets = merged(boxMesh({0.3, 0.3, 0.3}), flipped(mirroredBox({0.3, 0.3, 0.3})));
  BodyDescription link = test::body("part", test::meshShape(sheets));
  if (beside) link.geometry.push_back({*beside, translation({2, 0, 0}), "beside", false});
  return link;
}

/// For pairs decided by triangles, by fields of half-spaces, and by voxels.
TEST(DoubtfulMesh, WhatIsInsideIsNeverClearWhateverItIs) {
  TriangleMesh open = boxMesh({0.3, 0.3, 0.3});
  open.triangles.pop_back();
  BodyDescription voxel = test::body("bead", test::meshShape(boxMesh({0.02, 0.02, 0.02})));
  voxel.geometry.front().watertight_voxels = true;
  BodyDescription plane = test::body("bead", Primitive(Box::fromSize({0.04, 0.04, 0.04})));
  plane.geometry.push_back({Primitive(HalfSpace{Vector3d::UnitZ(), -5.0}), Isometry3d::Identity(), "plane", false});
  const BodyDescription box = test::body("bead", Primitive(Box::fromSize({0.04, 0.04, 0.04})));
  const std::pair<BodyDescription, BodyDescription> pairs[] = {
      {box, doubtfulLink(std::nullopt)},
      {box, doubtfulLink(test::meshShape(open))},
      {box, doubtfulLink(Primitive(HalfSpace{Vector3d::UnitZ(), -5.0}))},
      {voxel, doubtfulLink(std::nullopt)},
      {plane, doubtfulLink(std::nullopt)}};
  int which = 0;
  for (const auto& [bead, link] : pairs) {
    SCOPED_TRACE(which++);
    Monitor monitor(test::build({bead, link}, test::fine(0.02)), test::soft());
    const auto verdict = [&](const Vector3d& start, const Vector3d& end) {
      const CycleMotion motion =
          test::cycle(0.1, {{translation(start), translation(end)}, test::still(Isometry3d::Identity())});
      return monitor.run(motion, {}).pairs.front().verdict;
    };
    EXPECT_EQ(verdict({0, 0, 0}, {0.01, 0, 0}), Verdict::kUncertain);
    EXPECT_EQ(verdict({0.5, 0, 0}, {0.5, 0.1, 0}), Verdict::kClear);
    EXPECT_EQ(verdict({0.6, 0, 0}, {0.3, 0, 0}), Verdict::kContact);
  }
}

}  // namespace sdf_ccd::doubtful_mesh_test
