// Verdicts and distances of bodies whose fields and shells are not made yet are those of bodies that have them.

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "sdf_ccd/scene.h"
#include "shell/point_shell.h"

namespace sdf_ccd::forces_test {

using namespace test;

constexpr double kHalf = 0.1;  // of cubes [m]

/// Two cubes, one of which moves, and the ground below, which is in one body with a mesh.
SceneDescription cubes(Forces of_a, Forces of_b) {
  SceneDescription scene{{body("a", meshShape(boxMesh(Vector3d::Constant(kHalf)))),
                          body("b", meshShape(boxMesh(Vector3d::Constant(kHalf))), true),
                          body("ground", meshShape(boxMesh(Vector3d::Constant(kHalf))), true)},
                         {}};
  scene.bodies[0].forces = of_a;
  scene.bodies[1].forces = of_b;
  scene.bodies[2].forces = of_b;
  scene.bodies[2].geometry[0].X_BG = translation({5.0, 0.0, 0.0});
  scene.bodies[2].geometry.push_back({Primitive(HalfSpace{Vector3d::UnitZ(), -1.0}), Isometry3d::Identity(), "plane"});
  return scene;
}

CycleMotion moved(const Vector3d& from, const Vector3d& to) {
  return cycle(1.0,
               {{translation(from), translation(to)}, still(Isometry3d::Identity()), still(Isometry3d::Identity())});
}

/// Distance of the cubes a and b, with a at this place.
double gapOfCubes(const Vector3d& at) {
  return (at.cwiseAbs() - Vector3d::Constant(2.0 * kHalf)).cwiseMax(0.0).norm();
}

CycleRequest all() {
  CycleRequest request;
  request.contacts = request.wrenches = request.skipped_pairs = true;
  return request;
}

TEST(Forces, PlanLeavesFieldsAndShellsOut) {
  const ScenePlan plan = planScene(cubes(Forces::kAwaited, Forces::kKnown));
  ASSERT_EQ(plan.pairs.size(), 2U);
  for (const PlannedPair& pair : plan.pairs) EXPECT_FALSE(pair.a_shell_b_field || pair.b_shell_a_field);
  for (const BodyNeeds& needs : plan.needs) {
    EXPECT_FALSE(needs.field || needs.shell);
    EXPECT_TRUE(needs.triangles);
  }
  for (const PartReport* part : {&plan.parts[0].field, &plan.parts[0].shell}) {
    EXPECT_EQ(part->state, PartState::kAwaited);
    EXPECT_EQ(part->text, "its field and shell are being built");
  }
  for (const PartReports& parts : plan.parts) EXPECT_EQ(parts.surface.state, PartState::kReady);
}

TEST(Forces, ContactsWithoutThemSaySo) {
  const auto scene = build(cubes(Forces::kAwaited, Forces::kAwaited));
  for (const Body& body : scene->bodies) EXPECT_TRUE(body.parts.empty() && body.shell->size() == 0);
  Monitor monitor(scene, soft());
  const PairResult pair = monitor.run(moved({0.3, 0.01, 0.02}, {0.195, 0.01, 0.02}), all()).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_FALSE(pair.incomplete);
  ASSERT_EQ(pair.intervals.size(), 1U);
  EXPECT_GE(pair.deepest.depth + pair.deepest.depth_error, 0.005 - 1e-9);
  EXPECT_TRUE(pair.on_a_W.force.hasNaN() && pair.on_b_W.torque.hasNaN());
  EXPECT_EQ(pair.reason, "no force: a: its field and shell are being built");
  for (int k = 0; k < 4; ++k) {  // at rest, where it is answered once
    const PairResult rest = monitor.run(moved({0.195, 0.01, 0.02}, {0.195, 0.01, 0.02}), all()).pairs[0];
    EXPECT_EQ(rest.reason, pair.reason);
    EXPECT_TRUE(rest.on_a_W.force.hasNaN());
  }
  EXPECT_EQ(monitor.run(moved({0.195, 0.01, 0.02}, {0.3, 0.01, 0.02}), all()).pairs[0].verdict, Verdict::kContact);
  const PairResult apart = monitor.run(moved({0.3, 0.01, 0.02}, {0.4, 0.01, 0.02}), all()).pairs[0];
  EXPECT_EQ(apart.verdict, Verdict::kClear);
  EXPECT_EQ(apart.on_a_W.force, Vector3d::Zero());
}

TEST(Forces, VerdictsDoNotDependOnThem) {
  Random random(1);
  Monitor with(build(cubes(Forces::kKnown, Forces::kKnown)), {}),
      without(build(cubes(Forces::kAwaited, Forces::kAwaited)), {});
  Vector3d at(1.0, 0.0, 0.0);
  int contacts = 0;
  for (int i = 0; i < 400; ++i) {
    const Vector3d from = at;
    for (int k = 0; k < 3; ++k) at[k] = uniform(random, -0.3, 0.3);
    if (i % 5 == 0) at.z() = uniform(random, -1.3, -0.7);
    const CycleResult a = with.run(moved(from, at), all()), b = without.run(moved(from, at), all());
    for (std::size_t p = 0; p < a.pairs.size(); ++p) {
      ASSERT_EQ(a.pairs[p].verdict, b.pairs[p].verdict) << i << " " << p;
      const double gap = p == 0 ? gapOfCubes(at) : at.z() - kHalf + 1.0;
      ASSERT_LE(a.pairs[p].clearance, gap) << i << " " << p;
      ASSERT_LE(b.pairs[p].clearance, gap) << i << " " << p;
      ASSERT_NEAR(a.pairs[p].error.total(), b.pairs[p].error.total(), 1e-12);
      contacts += a.pairs[p].verdict == Verdict::kContact;
    }
  }
  EXPECT_GT(contacts, 80);
}

/// As they come, body by body, the result becomes that of a scene that had them from the start.
TEST(Forces, FollowInLaterVersions) {
  SceneDescription description = cubes(Forces::kAwaited, Forces::kAwaited);
  const BodyOptions options = fine();
  WorldEditor editor(options);
  const ScenePlan plan = planScene(description, planOptions(options));
  const auto first = editor.begin(description, plan, buildScene(description, plan, options));
  Monitor monitor(first->scene, soft());
  const CycleMotion motion = moved({0.195, 0.01, 0.02}, {0.19, 0.01, 0.02});
  EXPECT_TRUE(monitor.run(motion, all()).pairs[0].on_a_W.force.hasNaN());

  description.bodies[0].forces = Forces::kKnown;
  auto next = editor.next(description);
  monitor.adopt(*monitor.prepare(next->scene, &motion));
  EXPECT_EQ(monitor.run(motion, all()).pairs[0].reason, "no force: b: its field and shell are being built");

  description.bodies[1].forces = description.bodies[2].forces = Forces::kKnown;
  next = editor.next(description);
  EXPECT_EQ(next->prepared, 2);  // two cubes are one
  monitor.adopt(*monitor.prepare(next->scene, &motion));
  const PairResult known = monitor.run(motion, all()).pairs[0];
  const PairResult expected = Monitor(build(cubes(Forces::kKnown, Forces::kKnown)), soft()).run(motion, all()).pairs[0];
  EXPECT_EQ(known.reason, "");
  EXPECT_GT(expected.on_a_W.force.x(), 0.0);
  EXPECT_NEAR((known.on_a_W.force - expected.on_a_W.force).norm(), 0.0, 1e-9 * expected.on_a_W.force.norm());
}

}  // namespace sdf_ccd::forces_test
