// One bad mesh must not keep a robot from being checked: what a body may take to prepare is limited.
#include <gtest/gtest.h>

#include <chrono>

#include "common/cancel_point.h"
#include "common/seconds_since.h"
#include "oracle/busy_machine.h"
#include "oracle/hostile_meshes.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/scene.h"
#include "shell/point_shell.h"

namespace sdf_ccd::preparation_time_test {

using namespace test;

constexpr double kLimit = 0.25, kSlack = 0.5;  // on an idle machine [s]

BodyOptions limited(double seconds = kLimit * slowness()) {
  BodyOptions options = fine();
  options.max_preparation_time = seconds;
  return options;
}

/// Builds a robot of a ball, a link with this mesh, twice, and a box.
void expectOthersAreBuilt(const TriangleMesh& hostile) {
  const SceneDescription description{
      {body("ball", meshShape(icosphere(0.1, 2))), body("hostile", meshShape(hostile)),
       body("twin", meshShape(hostile)), body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})))},
      {}};
  const auto start = std::chrono::steady_clock::now();
  const Scene scene = buildScene(description, planScene(description, planOptions(limited())), limited());
  EXPECT_LT(secondsSince(start), (kLimit + kSlack) * slowness());
  EXPECT_TRUE(scene.bodies[0].failure.empty()) << scene.bodies[0].failure;
  EXPECT_TRUE(scene.bodies[3].failure.empty()) << scene.bodies[3].failure;
  for (const int late : {1, 2}) {
    EXPECT_NE(scene.bodies[late].failure.find("max_preparation_time"), std::string::npos) << scene.bodies[late].failure;
    EXPECT_EQ(scene.reports[late].field.state, PartState::kFailed);
    EXPECT_EQ(scene.reports[late].name, scene.bodies[late].name);
  }
}

TEST(PreparationTime, StopsAStarOfTriangles) {
  expectOthersAreBuilt(starMesh(100000));
}

TEST(PreparationTime, StopsNeedles) {
  expectOthersAreBuilt(needlesMesh(100000, 0.01));
}

TEST(PreparationTime, StopsRandomTriangles) {
  expectOthersAreBuilt(randomTrianglesMesh(20000));
}

TEST(PreparationTime, StopsNestedShells) {
  expectOthersAreBuilt(nestedMesh(5000));
}

/// The pairs of the body that failed are in the scene, and not checked.
TEST(PreparationTime, PairsOfALateBodyAreNotChecked) {
  const auto scene = build({body("hostile", meshShape(randomTrianglesMesh(20000))), body("a", Primitive(Sphere{0.1})),
                            body("b", Primitive(Box::fromSize({0.2, 0.2, 0.2})))},
                           limited());
  Monitor monitor(scene, soft());
  const CycleResult result = monitor.run(
      cycle(0.1, {still(translation({0, 0, 0})), still(translation({5, 0, 0})), still(translation({9, 0, 0}))}), {});
  ASSERT_EQ(result.pairs.size(), 3u);
  for (const PairResult& pair : result.pairs) {
    const bool is_late = pair.body_a == 0 || pair.body_b == 0;
    EXPECT_EQ(pair.verdict, is_late ? Verdict::kNotChecked : Verdict::kClear) << pair.body_a << ' ' << pair.body_b;
  }
}

/// An object that cannot be prepared in time is refused by name; the world stays.
TEST(PreparationTime, AnEditRefusesALateObject) {
  WorldEditor editor(limited());
  const SceneDescription before{
      {body("ball", meshShape(icosphere(0.1, 2))), body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})))}, {}};
  const auto known = editor.next(before);
  SceneDescription after = before;
  after.bodies.push_back(body("hostile", meshShape(randomTrianglesMesh(20000))));
  const auto start = std::chrono::steady_clock::now();
  try {
    editor.next(after);
    FAIL() << "not refused";
  } catch (const std::exception& error) {
    EXPECT_EQ(std::string(error.what()).rfind("hostile: preparing it takes more than the ", 0), 0u) << error.what();
  }
  EXPECT_LT(secondsSince(start), (kLimit + kSlack) * slowness());
  EXPECT_EQ(editor.next(before)->version, known->version + 1) << "a refused object makes no version";
}

/// The caller's own request is not taken for the limit.
TEST(PreparationTime, ACancelledBuildIsNoFailure) {
  const SceneDescription description{
      {body("hostile", meshShape(randomTrianglesMesh(20000))), body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})))},
      {}};
  const CancelScope scope(CancelRequest::Clock::now() + std::chrono::milliseconds(100));
  EXPECT_THROW(buildScene(description, planScene(description), limited(60.0)), Cancelled);
}

TEST(PreparationTime, WithinTheLimitNothingChanges) {
  const auto free = build({body("a", meshShape(icosphere(0.1, 3))), body("b", Primitive(Sphere{0.1}))}, fine());
  const auto timed = build({body("a", meshShape(icosphere(0.1, 3))), body("b", Primitive(Sphere{0.1}))}, limited(60.0));
  EXPECT_TRUE(timed->bodies[0].failure.empty());
  EXPECT_EQ(timed->bodies[0].shell->size(), free->bodies[0].shell->size());
  EXPECT_EQ(timed->bodies[0].parts[0].field.cells(), free->bodies[0].parts[0].field.cells());
}

}  // namespace sdf_ccd::preparation_time_test
