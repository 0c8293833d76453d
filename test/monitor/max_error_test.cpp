#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "oracle/failure.h"
#include "oracle/scene_case.h"
#include "scene/error_budget.h"

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
  hand.geometry.push_back(
      {Primitive(Cylinder::fromRadiusAndLength(0.008, 0.11)), pose({0.09, 0, 0}, 1.5707963, {0, 1, 0}), "finger"});
  hand.geometry.push_back({Primitive(Sphere{0.008}), translation({0.145, 0, 0}), "tip"});
  for (const double max_error : {0.005, 0.002}) {
    const auto scene = build({hand, body("other", meshShape(boxMesh({0.1, 0.05, 0.03})))}, optionsFor({max_error}));
    EXPECT_LE(scene->contact_bound.total(), max_error);
    EXPECT_LE(scene->reports[0].gap,
              divideErrorBudget(max_error).edge_gap * (1.0 + 1e-9) + scene->bodies[0].shell->position_error);
  }
}

TEST(MaxError, ATableNeedsNoShellAgainstALink) {
  const SceneDescription description{{body("table", Primitive(Box::fromSize({2.0, 1.2, 0.04})), true),
                                      body("link", meshShape(boxMesh({0.1, 0.05, 0.03})))},
                                     {}};
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
  BodyOptions options = optionsFor({0.002});
  const SceneDescription description{{body("a", meshShape(icosphere(0.1, 3))), body("b", Primitive(Sphere{0.05}))}, {}};
  const std::vector<BodyReport> fine = build(description, options)->reports;
  options.field.max_bytes = fine[0].field_bytes - 1;
  options.shell.max_points = std::min(fine[0].shell_points, fine[1].shell_points) - 1;
  const auto scene = build(description, options);
  for (const Body& body : scene->bodies) EXPECT_EQ(body.failure, "");
  EXPECT_GT(scene->contact_bound.total(), 0.002);
  ASSERT_EQ(scene->reports[0].warnings.size(), 2u);
  EXPECT_NE(scene->reports[0].warnings[0].find("m is used instead"), std::string::npos)
      << scene->reports[0].warnings[0];
  EXPECT_EQ(scene->reports[1].warnings.size(), 1u);
  EXPECT_NE(planTable(*scene).find("within the max_error of 2.00"), std::string::npos) << planTable(*scene);
  options.divides_max_error = false;  // explicit settings are not changed
  EXPECT_NE(build(description, options)->bodies[0].failure, "");
}

TEST(MaxError, ProgressIsOfAllBodies) {
  const SceneDescription description{
      {body("a", meshShape(icosphere(0.1, 3))), body("b", meshShape(boxMesh({0.2, 0.1, 0.05})))}, {}};
  const BodyOptions options = optionsFor({0.003});
  double last = 0.0;
  std::set<std::string> names;
  buildScene(description, planScene(description, planOptions(options)), options,
             [&](const std::string& name, double share) {
               EXPECT_GE(share, last);
               last = share;
               names.insert(name);
             });
  EXPECT_EQ(last, 1.0);
  EXPECT_EQ(names, (std::set<std::string>{"a", "b"}));
}

/// The files that a body has in the cache are named once, also if they were loaded.
TEST(MaxError, ReportsNameTheFilesOfTheCache) {
  const TriangleMesh ball = icosphere(0.1, 3);
  const SceneDescription description{
      {body("a", meshShape(ball)), body("b", meshShape(boxMesh({0.2, 0.1, 0.05}))), body("c", meshShape(ball))}, {}};
  BodyOptions options = optionsFor({0.003});
  options.cache_directory = testing::TempDir() + "sdf_ccd_max_error_test_" + std::to_string(getpid());
  for (const char* what : {"made", "loaded"}) {
    std::multiset<std::string> named;
    std::set<std::string> files;
    const auto scene = build(description, options);
    for (const BodyReport& report : scene->reports) named.insert(report.files.begin(), report.files.end());
    for (const auto& entry : std::filesystem::directory_iterator(options.cache_directory)) {
      const std::string ending = entry.path().extension().string();
      if (ending == ".field" || ending == ".shell") files.insert(entry.path().filename().string());
    }
    EXPECT_EQ(files.size(), 4u) << what;
    EXPECT_EQ(std::set<std::string>(named.begin(), named.end()), files) << what;
  }
  std::filesystem::remove_all(options.cache_directory);
}

/// The error message of building the scene; empty if it does not throw.
std::string refusal(const SceneDescription& description, const BodyOptions& options) {
  return failureOf<std::logic_error>(
      [&] { buildScene(description, planScene(description, planOptions(options)), options); });
}

TEST(MaxError, WhatCannotBeMeantOrAffordedIsRefused) {
  const SceneDescription description{
      {body("ball", meshShape(icosphere(0.1, 3))), body("pin", Primitive(Cylinder::fromRadiusAndLength(0.01, 0.2))),
       body("bead", Primitive(Sphere{0.02})), body("floor", Primitive(HalfSpace{{0, 0, 1}, 0.0}), true)},
      {}};
  EXPECT_EQ(refusal(description, optionsFor({0.003})), "");
  EXPECT_EQ(
      refusal(description, optionsFor({1e9})).find("a max_error of 1e+09 m is larger than every body: ball is 0.34"),
      0u)
      << refusal(description, optionsFor({1e9}));
  BodyOptions tiny = optionsFor({1e-3});
  tiny.field.max_bytes = 10'000;
  const std::string field = refusal(description, tiny);
  EXPECT_EQ(field.find("a max_error of 0.001 m is too small for ball: field: a maximum error of "), 0u) << field;
  EXPECT_NE(field.find(" m needs more than the limit of 0 MB"), std::string::npos) << field;
  tiny = optionsFor({1e-3});
  tiny.shell.max_points = 1000;
  const std::string shell = refusal(description, tiny);
  EXPECT_EQ(shell.find("a max_error of 0.001 m is too small for ball: a point every "), 0u) << shell;
  EXPECT_NE(shell.find(" needs more than 1000 points"), std::string::npos) << shell;
  EXPECT_NE(refusal(description, optionsFor({1e-8})).find(" is too small for ball: "), std::string::npos);
  // Explicit settings concern one body after the other.
  tiny.divides_max_error = false;
  EXPECT_EQ(refusal(description, tiny), "");
}

}  // namespace sdf_ccd::max_error_test
