#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"
#include "oracle/files.h"
#include "oracle/scene_case.h"
#include "shell/point_shell.h"

namespace sdf_ccd::build_scene_test {

using namespace test;

TEST(BuildScene, PrimitivesHaveExactFields) {
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Box::fromSize({0.2, 0.2, 0.2})))});
  for (const Body& body : scene->bodies) {
    ASSERT_EQ(body.parts.size(), 1u);
    EXPECT_NE(body.parts[0].field.primitive(), nullptr);
    EXPECT_GT(body.shell->size(), 0u);
    EXPECT_LE(body.shell->covering_radius, 0.01 * (1 + 1e-9));
    EXPECT_EQ(body.tree->nodes[0].end, static_cast<int>(body.shell->size()));
    for (const Vector3d& p : body.shell->points()) ASSERT_LE((p - body.ball.center).norm(), body.ball.radius + 1e-12);
  }
  EXPECT_EQ(scene->reports[0].geometry, "sphere");
  EXPECT_EQ(scene->reports[0].field.text, "exact");
}

TEST(BuildScene, BuildsOnlyWhatThePlanNeeds) {
  const auto scene = build({body("ground", ground(), true), body("a", meshShape(icosphere(0.1, 2)))});
  EXPECT_EQ(scene->bodies[0].shell->size(), 0u);
  EXPECT_EQ(scene->bodies[0].parts.size(), 1u);
  EXPECT_TRUE(scene->bodies[1].parts.empty());
  EXPECT_EQ(scene->reports[1].field.state, PartState::kNotNeeded);
  EXPECT_EQ(scene->reports[0].field.state, PartState::kReady);
  EXPECT_EQ(scene->reports[0].shell.state, PartState::kNotNeeded);
}

TEST(BuildScene, EqualMeshesAreBuiltOnce) {
  // Two meshes of equal content, as from loading a file twice.
  const auto scene =
      build({body("left finger", meshShape(icosphere(0.05, 2))), body("right finger", meshShape(icosphere(0.05, 2))),
             body("thumb", meshShape(icosphere(0.06, 2)))});
  const auto* left = FieldAccess::grid(scene->bodies[0].parts[0].field);
  EXPECT_EQ(left, FieldAccess::grid(scene->bodies[1].parts[0].field));
  EXPECT_NE(left, FieldAccess::grid(scene->bodies[2].parts[0].field));
  EXPECT_EQ(scene->reports[1].field.text, "shared");
  EXPECT_EQ(scene->reports[1].field_bytes, 0u);
  EXPECT_GT(scene->reports[0].field_bytes, 0u);
}

TEST(BuildScene, EqualVoxelsAndMeshesAreNotTakenForEachOther) {
  BodyDescription map = body("map", meshShape(boxMesh({0.1, 0.1, 0.1})), true);
  map.geometry[0].watertight_voxels = true;
  const auto scene = build({body("box", meshShape(boxMesh({0.1, 0.1, 0.1}))), map});
  EXPECT_EQ(scene->reports[0].geometry, "mesh (12 triangles, closed)");
  EXPECT_EQ(scene->reports[1].geometry, "voxels (12 triangles)");
}

TEST(BuildScene, AMapMayHaveCellsOfItsOwn) {
  BodyDescription map = body("map", meshShape(boxMesh({1.0, 1.0, 1.0})), true);
  map.geometry[0].watertight_voxels = true;
  map.geometry[0].cell_size = 0.1;
  for (const bool by_error : {false, true}) {
    BodyOptions options = fine();
    if (by_error) options.field = {{}, {}, 0.001};
    const auto scene = build({map, body("hand", meshShape(icosphere(0.1, 2)))}, options);
    EXPECT_NEAR(FieldAccess::grid(scene->bodies[0].parts[0].field)->shape().cell, 0.1, 1e-12);
    EXPECT_NEAR(scene->bodies[0].parts[0].field.errorBound(), 0.1 * std::sqrt(3.0) / 2.0, 1e-3);
  }
}

/// Where somebody has set the cells; those that follow the sizes of the bodies are made larger.
TEST(BuildScene, AFieldThatIsLargerThanAllowedIsRejected) {
  for (const bool is_set : {true, false}) {
    BodyOptions options = optionsForContacts();
    if (is_set) {
      options.cells_across = 0.0;
      options.field.cell_size = 0.0005;
    }
    options.field.max_bytes = 20 << 10;
    const auto scene =
        build({body("ball", meshShape(icosphere(0.1, 3))), body("other", meshShape(icosphere(0.12, 3)))}, options);
    EXPECT_EQ(scene->bodies[0].failure.find("MB allowed") != std::string::npos, is_set) << scene->bodies[0].failure;
    EXPECT_EQ(scene->reports[0].warnings.empty(), is_set);
  }
}

TEST(BuildScene, DefaultOptionsAreEnough) {
  const auto scene =
      build({body("a", meshShape(icosphere(0.05, 2))), body("b", meshShape(boxMesh({0.1, 0.1, 0.1})))}, BodyOptions());
  for (const Body& body : scene->bodies) {
    EXPECT_EQ(body.failure, "");
    ASSERT_EQ(body.parts.size(), 1u);
    EXPECT_LE(body.parts[0].field.errorBound(), optionsFor(Accuracy()).field.max_error.value());
  }
  EXPECT_DOUBLE_EQ(optionsFor(Accuracy()).field.max_error.value(), FieldOptions::kDefaultMaxError);
}

TEST(BuildScene, BandHoldsTheMargin) {
  const BodyOptions options = fine(0.004);
  const auto scene = build({body("a", meshShape(icosphere(0.1, 3))), body("b", Primitive(Sphere{0.1}))}, options);
  const DistanceField& field = scene->bodies[0].parts[0].field;
  EXPECT_GE(field.band(), 1.05 * (options.shell.spacing + field.errorBound() + options.motion_margin));
}

TEST(BuildScene, OneBodysFailureIsItsOwn) {
  BodyDescription broken = body("broken", meshShape({}));
  const auto scene = build({body("a", Primitive(Sphere{0.1})), broken, body("b", Primitive(Sphere{0.1}))});
  EXPECT_FALSE(scene->bodies[1].failure.empty());
  EXPECT_TRUE(scene->bodies[0].failure.empty());
  Monitor monitor(scene, {});
  CycleMotion motion = cycle(0.1, {still(translation({0, 0, 0})), {}, still(translation({1, 0, 0}))});
  const CycleResult& result = monitor.run(motion, {});
  EXPECT_EQ(result.not_checked, 2);
  EXPECT_EQ(result.checked, 1);
  EXPECT_EQ(result.pairs[0].reason, scene->bodies[1].failure);
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_NE(planTable(*scene).find("broken: " + scene->bodies[1].failure), std::string::npos);
}

/// Neither other pairs' delays, a reset nor another scene makes a pair of it anything else, and it costs no test.
TEST(BuildScene, PairsOfABodyThatFailedAreNeverDue) {
  const auto scene =
      build({body("a", Primitive(Sphere{0.1})), body("broken", meshShape({})), body("b", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, {});
  CycleMotion motion = cycle(0.1, {still(translation({0, 0, 0})), {}, still(translation({1, 0, 0}))});
  const auto expectNotChecked = [&](const CycleMotion& with, int checked, int skipped, int delayed) {
    const CycleResult& result = monitor.run(with, {});
    EXPECT_EQ(result.verdict, Verdict::kNotChecked);
    EXPECT_EQ(result.not_checked, 2);
    EXPECT_EQ(result.checked, checked);
    EXPECT_EQ(result.skipped, skipped);
    EXPECT_EQ(result.delayed, delayed);
    EXPECT_EQ(result.failed, (std::vector<int>{0, 2}));
    EXPECT_TRUE(result.not_clear.empty());
    for (const int pair : result.failed) {
      EXPECT_EQ(result.pairs[pair].verdict, Verdict::kNotChecked);
      EXPECT_EQ(result.pairs[pair].reason, scene->bodies[1].failure);
      EXPECT_FALSE(result.pairs[pair].span.empty());
      EXPECT_FALSE(result.pairs[pair].skipped);
    }
  };
  expectNotChecked(motion, 1, 0, 0);
  expectNotChecked(motion, 0, 1, 0);
  CycleMotion late = motion;
  late.spans = {{0, 0}, {0, 0}, {0, 0}};
  expectNotChecked(late, 0, 0, 1);
  expectNotChecked(motion, 0, 1, 0);
  CycleRequest brief;
  brief.skipped_pairs = false;
  monitor.run(motion, brief);
  monitor.reset();
  expectNotChecked(motion, 1, 0, 0);
  monitor.adopt(*monitor.prepare(scene));
  expectNotChecked(motion, 0, 1, 0);
}

TEST(BuildScene, UnionShellStillCoversTheUnion) {
  // A long box through a ball: points deep inside the other part are dropped, and the union's surface stays covered.
  BodyDescription cross = body("cross", Primitive(Sphere{0.1}));
  cross.geometry.push_back({Primitive(Box::fromSize({0.6, 0.06, 0.06})), translation({0.02, 0.01, 0}), "box", false});
  const auto scene = build({cross, body("other", Primitive(Sphere{0.1}))}, fine(0.01));
  const Body& body = scene->bodies[0];
  const Primitive ball = Sphere{0.1}, box = Box::fromSize({0.6, 0.06, 0.06});
  const Isometry3d X_GB = cross.geometry[1].X_BG.inverse();
  const auto inUnion = [&](const Vector3d& p) {
    return std::min(signedDistance(ball, p), signedDistance(box, X_GB * p));
  };
  double deepest = 0.0, hidden_area = 0.0;
  for (std::size_t i = 0; i < body.shell->size(); ++i) {
    const double depth = -inUnion(body.shell->point(i));
    deepest = std::max(deepest, depth);
    if (depth > body.shell->position_error + 1e-9) hidden_area += body.shell->areas[i];
  }
  EXPECT_LE(deepest, body.shell->covering_radius + 1e-9);
  EXPECT_GT(deepest, 0.3 * body.shell->covering_radius);
  EXPECT_EQ(hidden_area, 0.0);

  std::mt19937 random(1);
  std::normal_distribution<double> n;
  int tried = 0;
  for (int i = 0; i < 3000; ++i) {
    Vector3d q = 0.1 * Vector3d(n(random), n(random), n(random)).normalized();
    if (i % 2) {
      std::uniform_real_distribution<double> u(-1, 1);
      q = cross.geometry[1].X_BG * Vector3d(0.3 * u(random), 0.03 * u(random), 0.03);
    }
    if (inUnion(q) < -1e-12) continue;
    ++tried;
    double nearest = 1.0;
    for (const Vector3d& p : body.shell->points()) nearest = std::min(nearest, (p - q).norm());
    ASSERT_LE(nearest, body.shell->covering_radius);
  }
  EXPECT_GT(tried, 1000);
}

TEST(BuildScene, SecondStartTakesTheCache) {
  const std::string directory = testing::TempDir() + "sdf_ccd_scene_cache";
  std::filesystem::remove_all(directory);
  BodyOptions options = fine();
  options.cache_directory = directory;
  const std::vector<BodyDescription> bodies = {body("a", meshShape(icosphere(0.1, 2))),
                                               body("b", Primitive(Sphere{0.1}))};
  const auto first = build(bodies, options), second = build(bodies, options);
  EXPECT_EQ(first->reports[0].field.text.substr(0, 5), "built");
  EXPECT_EQ(second->reports[0].field.text, "cached");
  EXPECT_TRUE(second->reports[0].warnings.empty());
  EXPECT_FALSE(first->reports[0].is_cache_incomplete || second->reports[0].is_cache_incomplete);
  std::filesystem::remove_all(directory);
}

TEST(BuildScene, ACacheThatCannotBeUsedIsWarnedOfOnce) {
  const test::TemporaryDirectory directory;
  ASSERT_EQ(::chmod(directory.string().c_str(), 0777), 0);
  BodyOptions options = fine();
  options.cache_directory = directory.string();
  const auto scene = build({body("a", meshShape(icosphere(0.1, 1))), body("b", meshShape(icosphere(0.2, 1)))}, options);
  for (const BodyReport& report : scene->reports) {
    EXPECT_TRUE(report.warnings.empty()) << report.warnings[0];
    EXPECT_TRUE(report.is_cache_incomplete);
  }
  ASSERT_EQ(scene->warnings.size(), 1u);
  EXPECT_EQ(scene->warnings[0],
            "cache unavailable: " + directory.string() + ": other users can write to it (2 bodies)");
}

TEST(BuildScene, ReportsProgressUpToTheEnd) {
  const SceneDescription description{{body("a", meshShape(icosphere(0.1, 2))), body("b", Primitive(Sphere{0.1}))}, {}};
  double last = 0.0;
  buildScene(description, planScene(description), fine(), [&](const std::string&, double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1.0);
}

TEST(PlanTable, CountsPairsOfObjects) {
  SceneDescription description;
  for (const char* name : {"shelf", "table", "wall"}) {
    description.bodies.push_back(body(name, Primitive(Sphere{0.1})));
    description.bodies.back().is_world = true;
  }
  const std::string table = planTable(*build(description, fine(0.05)));
  EXPECT_NE(table.find("  3 pairs of two objects of the world\n"), std::string::npos) << table;
}

TEST(PlanTable, GroupsWhatWasLeftOutByReason) {
  SceneDescription description;
  for (int i = 0; i < 12; ++i) description.bodies.push_back(body("link" + std::to_string(i), Primitive(Sphere{0.1})));
  for (int i = 0; i < 12; ++i)
    for (int k = i + 1; k < 12; ++k)
      if (i + k > 1)
        description.allowed.push_back({"link" + std::to_string(i), "link" + std::to_string(k), "SRDF: Never"});
  const std::string table = planTable(*build(description, fine(0.05)));
  EXPECT_NE(table.find("65 pairs, SRDF: Never: link0 - link2, "), std::string::npos) << table;
  EXPECT_LT(std::count(table.begin(), table.end(), '\n'), 22) << table;
  // Aligned: every row ends in the column where the header ends.
  std::size_t width = table.find('\n'), start = 0;
  for (int row = 0; row < 13; ++row) {
    const std::size_t end = table.find('\n', start);
    EXPECT_EQ(end - start, width) << table;
    start = end + 1;
  }
  EXPECT_TRUE(std::all_of(table.begin(), table.end(), [](unsigned char c) { return c < 0x80; })) << table;
}

}  // namespace sdf_ccd::build_scene_test
