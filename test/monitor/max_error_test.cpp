#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "body/mesh_pool.h"
#include "model/error_budget.h"
#include "monitor/plan/scene_cost.h"
#include "oracle/failure.h"
#include "oracle/scene_case.h"
#include "shell/sample_surface.h"

namespace sdf_ccd::max_error_test {

using namespace test;

MonitorOptions chords(double max_error) {
  MonitorOptions options = soft();
  options.chords.tolerance = divideErrorBudget(max_error).chord_tolerance;
  return options;
}

TEST(MaxError, ReportedBoundIsKeptAndTrue) {
  // Two meshes of balls with 5 cm radius, one swinging past the other at a known distance.
  constexpr double kRadius = 0.05;
  const TriangleMesh ball = icosphere(kRadius, 4);
  for (const double max_error : {0.005, 0.001}) {
    const auto scene = build({body("still", meshShape(ball)), body("swung", meshShape(ball))}, optionsFor({max_error}));
    EXPECT_LE(scene->contact_bound.total(), max_error);
    EXPECT_GT(scene->contact_bound.total(), 0.8 * max_error);
    EXPECT_EQ(scene->bound.total(), scene->motion_error);  // triangles are exact
    Monitor monitor(scene, chords(max_error));
    int open = 0;
    for (const double apart : {-1.5, -0.5, -0.1, 0.1, 0.5, 1.5}) {  // in units of max_error
      const double distance = 2.0 * kRadius + apart * max_error;
      // On a circle about an opposite point, nearest halfway.
      const Vector3d pivot(distance + 0.3, 0.0, 0.0), arm(-0.3, 0.0, 0.0);
      const Isometry3d from = translation(pivot) * pose({0, 0, 0}, -0.3, {0, 0, 1}) * translation(arm);
      const Isometry3d to = translation(pivot) * pose({0, 0, 0}, 0.3, {0, 0, 1}) * translation(arm);
      monitor.reset();
      const PairResult& pair = monitor.run(cycle(0.1, {still(Isometry3d::Identity()), {from, to}}), {}).pairs[0];
      EXPECT_LE(pair.error.total(), pair.verdict == Verdict::kClear ? 1e-5 : max_error);
      EXPECT_LE(pair.contact_error.total(), max_error);
      EXPECT_EQ(pair.contact_error.total() > 0.0, pair.deepest.depth > 0.0);
      // The icosphere's faces are at most this far inside the ball.
      const double inside = 2.0 * kRadius * 0.002;
      if (apart * max_error > inside) {
        EXPECT_NE(pair.verdict, Verdict::kContact) << apart;
      }
      if (apart < 0.0 && -apart * max_error > inside) {
        EXPECT_NE(pair.verdict, Verdict::kClear) << apart;
      }
      if (apart > 1.0) {
        EXPECT_EQ(pair.verdict, Verdict::kClear) << max_error;
      }
      if (apart < -1.0) {
        EXPECT_EQ(pair.verdict, Verdict::kContact) << max_error;
      }
      open += pair.verdict == Verdict::kUncertain;
    }
    EXPECT_EQ(open, 0) << "what the fields leave open triangles decide";
  }
}

TEST(MaxError, BoxesAreToldApartAtAMillimetre) {
  const auto scene =
      build({body("a", meshShape(boxMesh({0.1, 0.05, 0.03}))), body("b", meshShape(boxMesh({0.1, 0.05, 0.03})))},
            optionsFor({0.001}));
  Monitor monitor(scene, chords(0.001));
  const auto verdictAt = [&](double apart) {
    monitor.reset();
    return monitor
        .run(cycle(0.1, {still(Isometry3d::Identity()), still(pose({0, 0, 0.06 + apart}, 0.5, {0, 0, 1}))}), {})
        .pairs[0]
        .verdict;
  };
  EXPECT_EQ(verdictAt(0.0017), Verdict::kClear);  // the bound plus the field's error
  EXPECT_EQ(verdictAt(-0.0017), Verdict::kContact);
}

TEST(MaxError, ABodyOfSeveralElementsIsHeldToItsShare) {
  BodyDescription hand = body("hand", meshShape(boxMesh({0.04, 0.03, 0.02})));
  hand.geometry.push_back({Primitive(Cylinder{0.008, 0.055}), pose({0.09, 0, 0}, 1.5707963, {0, 1, 0}), "finger"});
  hand.geometry.push_back({Primitive(Sphere{0.008}), translation({0.145, 0, 0}), "tip"});
  for (const double max_error : {0.005, 0.002}) {
    const auto scene = build({hand, body("other", meshShape(boxMesh({0.1, 0.05, 0.03})))}, optionsFor({max_error}));
    EXPECT_LE(scene->contact_bound.total(), max_error);
    EXPECT_LE(scene->reports[0].gap,
              divideErrorBudget(max_error).edge_gap * (1.0 + 1e-9) + scene->bodies[0].shell->position_error);
  }
}

TEST(MaxError, ATableNeedsNoShellAgainstALink) {
  const SceneDescription description{
      {body("table", Primitive(Box{{1.0, 0.6, 0.02}}), true), body("link", meshShape(boxMesh({0.1, 0.05, 0.03})))}, {}};
  const BodyOptions options = optionsFor({0.001});
  const ScenePlan plan = planScene(description, planOptions(options));
  ASSERT_FALSE(plan.needs[0].shell);
  ASSERT_TRUE(plan.needs[1].shell);
  const auto scene = std::make_shared<const Scene>(buildScene(description, plan, options));
  // The force is that of the link's whole shell, not half of it.
  const auto force = [](const std::shared_ptr<const Scene>& scene) {
    Monitor monitor(scene, soft());
    return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, 0.045}))}), {})
        .pairs[0]
        .on_b_W.force.z();
  };
  constexpr double kPressed = kStiffness * 0.2 * 0.1 * 0.005;
  EXPECT_NEAR(force(scene), kPressed, 0.15 * kPressed);
  // A corner of the table at the centre of the link's large face is detected.
  Monitor monitor(scene, chords(0.001));
  const Isometry3d tilted =
      translation({1.0, 0.6, 0.02}) * pose({0, 0, 0}, 0.9, {1, -1, 0}) * translation({0, 0, 0.029});
  EXPECT_EQ(monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(tilted)}), {}).pairs[0].verdict,
            Verdict::kContact);
}

TEST(MaxError, WhatWouldBeTooLargeIsMadeCoarserAndSaysSo) {
  BodyOptions options = optionsFor({0.0005});
  options.field.max_bytes = 100'000;
  options.shell.max_points = 3000;
  const SceneDescription description{{body("a", meshShape(icosphere(0.1, 3))), body("b", Primitive(Sphere{0.1}))}, {}};
  const auto scene = build(description, options);
  for (const Body& body : scene->bodies) EXPECT_EQ(body.failure, "");
  EXPECT_GT(scene->contact_bound.total(), 0.0005);
  ASSERT_EQ(scene->reports[0].warnings.size(), 2u);
  EXPECT_NE(scene->reports[0].warnings[0].find("m is used instead"), std::string::npos)
      << scene->reports[0].warnings[0];
  EXPECT_EQ(scene->reports[1].warnings.size(), 1u);
  EXPECT_NE(planTable(*scene).find("within the max_error of 0.50"), std::string::npos) << planTable(*scene);
  options.divides_max_error = false;  // explicit settings are not changed
  EXPECT_NE(build(description, options)->bodies[0].failure, "");
}

TEST(MaxError, CostIsExpectedWithinAFactorOfTwo) {
  const TriangleMesh ball = icosphere(0.1, 4);
  const SceneDescription description{
      {body("a", meshShape(ball)), body("b", meshShape(boxMesh({0.2, 0.1, 0.05}))), body("c", meshShape(ball)),
       body("table", Primitive(Box{{1.0, 0.6, 0.02}}), true)},
      {}};
  for (const double max_error : {0.005, 0.002}) {
    const BodyOptions options = optionsFor({max_error});
    const ScenePlan plan = planScene(description, planOptions(options));
    const SceneCost cost = expectedCost(description, plan, options);
    const Scene scene = buildScene(description, plan, options);
    double bytes = 0.0;
    for (const BodyReport& report : scene.reports) bytes += double(report.field_bytes + report.shell_bytes);
    EXPECT_LT(cost.bytes, 2.0 * bytes);
    EXPECT_GT(cost.bytes, bytes / 2.0);
    EXPECT_GT(cost.seconds, 0.0);
    EXPECT_EQ(cost.bodies.size(), 4u);
    EXPECT_GT(cost.bodies[0].field_seconds, 0.0);
    EXPECT_LE(cost.bodies[0].field_seconds, cost.bodies[0].seconds);
    EXPECT_EQ(cost.bodies[2].field_seconds, 0.0);  // the same mesh as a's
    EXPECT_EQ(summary(cost).find("about "), 0u) << summary(cost);
  }
}

TEST(MaxError, WhatWasExpectedIsNotMadeAgainAndChangesNothing) {
  const SceneDescription description{
      {body("a", meshShape(icosphere(0.1, 3))), body("b", meshShape(boxMesh({0.2, 0.1, 0.05})))}, {}};
  const BodyOptions options = optionsFor({0.003});
  ScenePlan plan = planScene(description, planOptions(options));
  const Scene alone = buildScene(description, plan, options);
  plan.expected = std::make_shared<const SceneCost>(expectedCost(description, plan, options));
  double last = 0.0;
  const Scene scene = buildScene(description, plan, options, [&](const std::string&, double share) {
    EXPECT_GE(share, last);
    last = share;
  });
  EXPECT_EQ(last, 1.0);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(scene.reports[i].cells, alone.reports[i].cells);
    EXPECT_EQ(scene.reports[i].field_bytes, alone.reports[i].field_bytes);
    EXPECT_EQ(scene.reports[i].shell_points, alone.reports[i].shell_points);
  }
}

TEST(MaxError, WhatTheCacheHasIsNotSampled) {
  const SceneDescription description{
      {body("a", meshShape(icosphere(0.1, 3))), body("b", meshShape(boxMesh({0.2, 0.1, 0.05})))}, {}};
  BodyOptions options = optionsFor({0.003});
  options.cache_directory = testing::TempDir() + "sdf_ccd_max_error_test_" + std::to_string(getpid());
  const ScenePlan plan = planScene(description, planOptions(options));
  buildScene(description, plan, options);
  const SceneCost cost = expectedCost(description, plan, options);
  ASSERT_EQ(cost.bodies.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(cost.bodies[i].in_cache);
    EXPECT_LT(cost.bodies[i].seconds, 0.01) << "for triangles, which are not cached";
    EXPECT_FALSE(cost.meshes->find(description.bodies[i].geometry[0]).made.solid);  // only a sample of cells needs it
  }
  std::filesystem::remove_all(options.cache_directory);
}

SceneCost affordable(const SceneDescription& description, const BodyOptions& options) {
  return affordableCost(description, planScene(description, planOptions(options)), options);
}

/// The error message of affordableCost(); empty if it does not throw.
std::string refusal(const SceneDescription& description, const BodyOptions& options) {
  return failureOf<std::logic_error>([&] { affordable(description, options); });
}

TEST(MaxError, WhatCannotBeMeantOrAffordedIsRefusedBeforeItIsBuilt) {
  const SceneDescription description{
      {body("ball", meshShape(icosphere(0.1, 3))), body("pin", Primitive(Cylinder{0.01, 0.1})),
       body("bead", Primitive(Sphere{0.02})), body("floor", Primitive(HalfSpace{{0, 0, 1}, 0.0}), true)},
      {}};
  EXPECT_GT(affordable(description, optionsFor({0.001})).bytes, 0.0);
  EXPECT_EQ(
      refusal(description, optionsFor({1e9})).find("a max_error of 1e+09 m is larger than every body: ball is 0.34"),
      0u)
      << refusal(description, optionsFor({1e9}));
  BodyOptions tiny = optionsFor({1e-5});
  tiny.field.max_bytes = 4'000'000;
  const std::string field = refusal(description, tiny);
  EXPECT_EQ(field.find("a max_error of 1e-05 m would take about "), 0u) << field;
  EXPECT_NE(field.find("; a field may take 4 MB, that of ball would take "), std::string::npos) << field;
  tiny.field.max_bytes = std::size_t{1} << 60;
  tiny.shell.max_points = 1000;
  EXPECT_NE(refusal(description, tiny).find("; a shell may have 1000 points, that of ball "), std::string::npos);
  EXPECT_NE(refusal(description, optionsFor({1e-8})).find("; this machine has "), std::string::npos);
}

TEST(MaxError, CostOfPrimitivesIsExpectedAlsoWhereItIsLarge) {
  for (const Primitive& shape : {Primitive(Sphere{0.1}), Primitive(Cylinder{0.1, 0.1})}) {
    const SceneDescription description{{body("a", shape), body("b", shape)}, {}};
    const BodyOptions options = optionsFor({0.0015});
    const BodyCost cost = affordable(description, options).bodies[0];
    const auto points = static_cast<double>(sampleSurface(shape, options.shell).size());
    EXPECT_LT(cost.shell_points, 3.0 * points);
    EXPECT_GT(cost.shell_points, points / 3.0);
  }
}

}  // namespace sdf_ccd::max_error_test
