#include "query/shell_query.h"

#include <algorithm>
#include <limits>
#include <map>

#include <gtest/gtest.h>

#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"
#include "oracle/random.h"
#include "oracle/screw_chords.h"
#include "oracle/shapes.h"
#include "sdf_ccd/field.h"
#include "sdf_ccd/segments.h"
#include "shell/point_shell.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::shell_query_test {

using test::Random;

BoundingBall rootBall(const SphereTree& tree) {
  return tree.nodes[0].ball();
}

/// Queries every point on every chord, without the tree. Grids are queried in batches, as in the shell query.
std::vector<ShellHit> linearScan(const DistanceField& field, const PointShell& shell, const ChordPath& path) {
  std::vector<ShellHit> hits;
  for (int c = 0; c < int(path.chords.size()); ++c) {
    std::vector<Segment> segments;
    for (const Vector3d& p : shell.points())
      segments.push_back({path.chords[c].X_FP_start * p, path.chords[c].X_FP_end * p});
    if (field.primitive()) {
      for (int i = 0; i < int(segments.size()); ++i)
        for (const Interval& interval : segmentIntervals(field, segments[i])) hits.push_back({i, c, interval});
      continue;
    }
    BatchResult found;
    segmentIntervals(field, segments.data(), segments.size(), {}, found);
    for (const SegmentHit& hit : found.hits) hits.push_back({int(hit.segment), c, {hit.enter, hit.exit}});
  }
  return hits;
}

std::vector<ShellHit> allHits(const ShellQueryResult& result) {
  std::vector<ShellHit> hits;
  listHits(result, hits);
  EXPECT_EQ(long(hits.size()), result.count());
  return hits;
}

void expectEqual(std::vector<ShellHit> tree, std::vector<ShellHit> scan) {
  const auto order = [](const ShellHit& a, const ShellHit& b) {
    return std::tie(a.chord, a.point, a.interval.enter) < std::tie(b.chord, b.point, b.interval.enter);
  };
  std::sort(tree.begin(), tree.end(), order);
  std::sort(scan.begin(), scan.end(), order);
  ASSERT_EQ(tree.size(), scan.size());
  for (std::size_t i = 0; i < tree.size(); ++i) {
    ASSERT_EQ(tree[i].point, scan[i].point);
    ASSERT_EQ(tree[i].chord, scan[i].chord);
    ASSERT_EQ(tree[i].interval.enter, scan[i].interval.enter);
    ASSERT_EQ(tree[i].interval.exit, scan[i].interval.exit);
  }
}

struct Scene {
  DistanceField field;
  PointShell shell;
  SphereTree tree;
};

std::vector<Scene> scenes() {
  FieldOptions field;
  field.cells = 40;
  ShellOptions shell;
  shell.spacing = 0.02;
  std::vector<Scene> all;
  const auto add = [&](DistanceField f, PointShell s) {
    SphereTree tree = buildSphereTree(s);
    all.push_back({std::move(f), std::move(s), std::move(tree)});
  };
  const TriangleMesh torus = test::torusMesh(0.2, 0.08, 48, 24);
  add(buildField(torus, field), sampleSurface(torus, shell));
  add(buildField(test::boxMesh({0.2, 0.2, 0.004}), field), sampleSurface(Primitive(Sphere{0.1}), shell));
  add(DistanceField(Primitive(Box::fromSize({0.4, 0.2, 0.001}))),
      sampleSurface(Primitive(Cylinder::fromRadiusAndLength(0.05, 0.2)), shell));
  return all;
}

TEST(ShellQuery, EqualsLinearScanOnAdaptiveField) {
  FieldOptions options;
  options.max_error = 0.001;
  const TriangleMesh torus = test::torusMesh(0.2, 0.08, 48, 24);
  const DistanceField field = buildField(torus, options);
  PointShell shell = sampleSurface(torus, {});
  const SphereTree tree = buildSphereTree(shell);
  Random random(8);
  long hits = 0, grazing = 0;
  for (int i = 0; i < 100; ++i) {
    const Isometry3d start = test::pose(random, 3.0, i % 2 ? 0.3 : 0.02);
    ChordPath path;
    path.chords.emplace_back();
    path.chords[0].X_FP_start = start;
    path.chords[0].X_FP_end = test::pose(random, 0.3, 0.1) * start;
    ShellQueryResult result;
    shellIntervals(field, shell, tree, path, result);
    std::map<int, double> inside;  // time by point
    for (const ShellHit& hit : allHits(result)) inside[hit.point] += hit.interval.exit - hit.interval.enter;
    hits += result.count();
    for (const ShellHit& hit : linearScan(field, shell, path))
      inside[hit.point] -= hit.interval.exit - hit.interval.enter;
    for (const auto& [point, difference] : inside) grazing += std::abs(difference) > 1e-5;
  }
  EXPECT_GT(hits, 5000);
  EXPECT_LE(grazing, hits / 1000);  // single precision, at leaves' faces
}

TEST(ShellQuery, EqualsLinearScanOnEveryPoint) {
  Random random(1);
  long hits = 0, visits = 0, points = 0;
  for (const Scene& scene : scenes()) {
    for (int i = 0; i < 200; ++i) {
      // Far and near, fast and slow, also with rotations by more than a right angle.
      const double reach = i % 4 == 0 ? 1.0 : 0.3;
      const std::vector<Isometry3d> poses{test::pose(random, 3.0, reach), test::pose(random, 3.0, reach),
                                          test::pose(random, i % 2 ? 0.1 : 3.0, reach)};
      const ChordPath path = test::screwChords(poses, rootBall(scene.tree), {i % 5 == 0 ? 1e-3 : 1e-1, 40}, 0.5);
      ShellQueryResult result;
      shellIntervals(scene.field, scene.shell, scene.tree, path, result);
      expectEqual(allHits(result), linearScan(scene.field, scene.shell, path));
      if (HasFatalFailure()) return;
      hits += result.count();
      visits += result.points_tested;
      points += long(scene.shell.size() * path.chords.size());
    }
  }
  EXPECT_GT(hits, 10000);
  EXPECT_LT(visits, points / 2) << "the tree culls nothing";
}

TEST(ShellQuery, EqualsLinearScanWhereOneNodeHoldsAllPoints) {
  Random random(9);
  std::size_t most = 0;
  for (const Scene& scene : scenes()) {
    most = std::max(most, scene.shell.size());
    SphereTree root{{scene.tree.nodes[0]}};
    root.nodes[0].first_child = -1;
    for (const double reach : {0.0, 0.01, 1.0}) {  // at rest, short paths, long paths
      ChordPath path;
      path.chords.emplace_back();
      path.chords[0].X_FP_start = test::pose(random, 3.0, 0.05);
      path.chords[0].X_FP_end = test::pose(random, reach, reach) * path.chords[0].X_FP_start;
      ShellQueryResult result;
      shellIntervals(scene.field, scene.shell, root, path, result);
      expectEqual(allHits(result), linearScan(scene.field, scene.shell, path));
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(most, 1000U) << "more than are asked together";
}

TEST(ShellQuery, EqualsLinearScanOnAdversarialMotions) {
  Random random(2);
  for (const Scene& scene : scenes()) {
    std::vector<std::pair<Isometry3d, Isometry3d>> ends;
    const auto at = [](const Vector3d& p) {
      Isometry3d X = Isometry3d::Identity();
      X.translation() = p;
      return X;
    };
    ends.push_back({at({0, 0, 0}), at({0, 0, 0})});        // no motion, deep overlap
    ends.push_back({at({50, 0, 0}), at({-50, 1e-4, 0})});  // through everything at once
    ends.push_back({at({0, 0, 1e3}), at({0, 0, -1e3})});
    ends.push_back({at({0, 0, 0.1}), at({0.4, 0, 0.1})});            // sphere slides along the plate's face
    ends.push_back({at({1e4, 1e4, 1e4}), at({1e4, 1e4, 1e4 + 1})});  // never near
    const AlignedBox3d box =
        FieldAccess::grid(scene.field) ? FieldAccess::grid(scene.field)->shape().box() : scene.field.surfaceBox();
    for (int k = 0; k < 3; ++k) {  // along the grid's own boundary
      Vector3d a = box.min(), b = box.min();
      b[k] = box.max()[k];
      ends.push_back({at(a), at(b)});
    }
    for (const auto& [from, to] : ends) {
      const ChordPath path = test::screwChords({from, to}, rootBall(scene.tree), {1e-3, 40});
      ShellQueryResult result;
      shellIntervals(scene.field, scene.shell, scene.tree, path, result);
      expectEqual(allHits(result), linearScan(scene.field, scene.shell, path));
      if (HasFatalFailure()) return;
    }
  }
}

/// A kind of motion: distance of the bodies, rotation and translation over a chord.
struct Motions {
  const char* name;
  double reach, turn, travel;
};
constexpr Motions kMotions[] = {
    {"random", 0.5, 3.0, 0.6}, {"small", 0.25, 0.01, 0.005}, {"deep", 0.03, 0.01, 0.005}, {"clear", 3.0, 0.01, 0.005}};

/// Points that are inside along the whole chord are those of the linear scan too, in fields of all kinds.
TEST(ShellQuery, EqualsLinearScanOnMotionsOfAllKinds) {
  Random random(11);
  const TriangleMesh torus = test::torusMesh(0.2, 0.08, 48, 24);
  FieldOptions adaptive, uniform;
  adaptive.max_error = 0.001;
  uniform.cells = 48;
  const std::vector<DistanceField> fields{buildField(torus, adaptive), buildField(torus, uniform),
                                          DistanceField(Primitive(Sphere{0.15}))};
  ShellOptions spacing;
  spacing.spacing = 0.01;
  PointShell shell = sampleSurface(torus, spacing);
  const SphereTree tree = buildSphereTree(shell);
  for (const Motions& kind : kMotions) {
    long hits = 0, inside = 0, tested = 0, points = 0;
    for (const DistanceField& field : fields) {
      for (int i = 0; i < 12; ++i) {
        ChordPath path;
        Isometry3d X_FP = test::pose(random, 3.0, kind.reach);
        if (kind.reach > 1.0) X_FP.translation() = kind.reach * test::direction(random);
        for (int c = 0; c < 1 + i % 3; ++c) {
          const Isometry3d end = test::pose(random, kind.turn, kind.travel) * X_FP;
          path.chords.push_back({double(c), c + 1.0, X_FP, end, 0});
          X_FP = end;
        }
        ShellQueryResult result;
        shellIntervals(field, shell, tree, path, result);
        expectEqual(allHits(result), linearScan(field, shell, path));
        if (HasFatalFailure()) FAIL() << kind.name;
        hits += long(result.hits.size());
        inside += result.count() - long(result.hits.size());
        tested += result.points_tested;
        points += long(shell.size() * path.chords.size());
      }
    }
    const bool clear = kind.reach > 1.0;
    EXPECT_EQ(hits == 0, clear) << kind.name;
    EXPECT_EQ(inside == 0, clear) << kind.name;
    EXPECT_LT(tested, points / 2) << kind.name;
  }
}

/// The field of an open mesh is that of a closed solid.
TEST(ShellQuery, EqualsLinearScanOnOpenMeshes) {
  Random random(12);
  TriangleMesh open = test::torusMesh(0.2, 0.08, 24, 12);
  ShellOptions spacing;
  spacing.spacing = 0.01;
  PointShell shell = sampleSurface(open, spacing);
  const SphereTree tree = buildSphereTree(shell);
  open.triangles.resize(open.triangles.size() * 3 / 4);
  FieldOptions adaptive, even;
  adaptive.max_error = 0.01;
  even.cells = 24;
  for (const DistanceField& field : {buildField(open, adaptive), buildField(open, even)}) {
    long hits = 0, grazing = 0;
    for (int i = 0; i < 40; ++i) {
      const Isometry3d start = test::pose(random, 3.0, 0.2);
      ChordPath path;
      path.chords.push_back({0.0, 1.0, start, test::pose(random, 0.01, i % 2 ? 0.005 : 0.5) * start, 0});
      ShellQueryResult result;
      shellIntervals(field, shell, tree, path, result);
      std::map<int, double> inside;  // time by point
      for (const ShellHit& hit : allHits(result)) inside[hit.point] += hit.interval.exit - hit.interval.enter;
      for (const ShellHit& hit : linearScan(field, shell, path)) {
        inside[hit.point] -= hit.interval.exit - hit.interval.enter;
      }
      for (const auto& [point, difference] : inside) grazing += std::abs(difference) > 1e-5;
      hits += result.count();
    }
    EXPECT_GT(hits, 500);
    EXPECT_LE(grazing, hits / 1000);  // single precision, at leaves' faces
  }
}

TEST(ShellQuery, ListsHitsByChordWithThoseInsideAllAlong) {
  ShellQueryResult result;
  result.hits = {{7, 0, {0.2, 0.4}}, {3, 1, {0.0, 0.5}}, {3, 1, {0.7, 1.0}}, {9, 3, {0.1, 0.2}}};
  result.inside = {{0, 2, 1}, {4, 5, 2}};
  EXPECT_EQ(result.count(), 7);
  const std::vector<ShellHit> hits = allHits(result);
  ASSERT_EQ(hits.size(), 7U);
  for (std::size_t i = 0; i + 1 < hits.size(); ++i) EXPECT_LE(hits[i].chord, hits[i + 1].chord);
  expectEqual(hits, {{7, 0, {0.2, 0.4}},
                     {3, 1, {0.0, 0.5}},
                     {3, 1, {0.7, 1.0}},
                     {0, 1, {0.0, 1.0}},
                     {1, 1, {0.0, 1.0}},
                     {4, 2, {0.0, 1.0}},
                     {9, 3, {0.1, 0.2}}});
}

TEST(ShellQuery, RefusesAPathThatIsNotFinite) {
  for (const Scene& scene : scenes()) {
    ChordPath path;
    path.chords.push_back({0.0, 1.0, Isometry3d::Identity(), Isometry3d::Identity(), 0});
    path.chords[0].X_FP_end.translation().setConstant(std::numeric_limits<double>::quiet_NaN());
    ShellQueryResult result;
    EXPECT_THROW(shellIntervals(scene.field, scene.shell, scene.tree, path, result), std::invalid_argument);
  }
}

TEST(ShellQuery, NodesWithoutPointsNeverHit) {
  const DistanceField field{Primitive(Box::fromSize({0.4, 0.4, 0.4}))};
  PointShell shell;
  SphereTree tree;
  tree.nodes.emplace_back();  // at the body's centre
  tree.nodes[0].first_child = -1;
  ChordPath path;
  path.chords.emplace_back();
  path.chords[0].X_FP_start = path.chords[0].X_FP_end = Isometry3d::Identity();
  ShellQueryResult result;
  shellIntervals(field, shell, tree, path, result);
  EXPECT_FALSE(result.touches());
}

TEST(ShellQuery, EmptyShellNeverHits) {
  const DistanceField field{Primitive(Sphere{1.0})};
  PointShell shell;
  const SphereTree tree = buildSphereTree(shell);
  ChordPath path;
  path.chords.push_back({0.0, 1.0, Isometry3d::Identity(), Isometry3d::Identity(), 0});
  ShellQueryResult result;
  shellIntervals(field, shell, tree, path, result);
  EXPECT_FALSE(result.touches());
}

}  // namespace sdf_ccd::shell_query_test
