#include "sdf_ccd/monitor.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "shell/point_shell.h"

namespace sdf_ccd::monitor_wrench_test {

using namespace test;

/// A ball pressed δ deep into a plate.
struct Pressed {
  double R = 0.1, delta = 0.005;
  double force() const { return kPi * kStiffness * R * delta * delta; }
};

TEST(MonitorWrench, BothRolesDoNotDouble) {
  const Pressed press;
  const auto scene = build(
      {body("ball", Primitive(Sphere{press.R})), body("block", Primitive(Box::fromSize({0.14, 0.14, 0.06})), true)},
      fine(0.003));
  Monitor monitor(scene, soft());
  const Isometry3d X_WA = translation({0.02, 0.03, 0.03 + press.R - press.delta});
  const PairResult pair = monitor.run(cycle(0.1, {still(X_WA), still(Isometry3d::Identity())}), {}).pairs[0];
  EXPECT_NEAR(pair.on_a_W.force.z(), press.force(), 0.05 * press.force());
  EXPECT_LT((pair.on_a_W.force + pair.on_b_W.force).norm(), 1e-9 * press.force());
  EXPECT_GT(pair.deepest.normal_W.z(), -1.0 - 1e-9);
  EXPECT_LT(pair.deepest.normal_W.z(), -0.9);  // from A, which is above, to B
}

/// More chords, and points on them, than one block holds: still one contact, with the same force.
TEST(MonitorWrench, HowFarABallRollsDoesNotMatter) {
  const Pressed press{0.1, 0.05};
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{press.R}))}, fine(0.003));
  Monitor monitor(scene, soft());
  std::vector<Isometry3d> X_WB;
  constexpr std::size_t kKnots = 20;
  for (std::size_t k = 0; k < kKnots; ++k)
    X_WB.push_back(pose({0, 0, press.R - press.delta}, 0.5 * double(k), {1, 0.2, 0}));
  const CycleMotion motion = cycle(0.5, {still(Isometry3d::Identity(), kKnots), X_WB});
  const PairResult pair = monitor.run(motion, {true, 1000000}).pairs[0];
  ASSERT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_NEAR(pair.on_b_W.force.z(), press.force(), 0.02 * press.force());
  ASSERT_EQ(pair.intervals.size(), 1u);
  EXPECT_NEAR(pair.intervals[0].enter, 0.0, 1e-6);
  EXPECT_NEAR(pair.intervals[0].exit, 0.5, 1e-6);
  EXPECT_NEAR(pair.deepest.depth, press.delta, 1e-4);
  // 9.5 rad: every point that comes down is below the ground for a third of a revolution, in one piece.
  std::size_t long_ones = 0;
  for (const ContactPoint& point : pair.points) {
    EXPECT_LT(point.exit - point.enter, 0.5 * 2.2 / 9.5);
    long_ones += point.exit - point.enter > 0.5 * 1.8 / 9.5;
  }
  EXPECT_GT(long_ones, 100u);
}

TEST(MonitorWrench, OrderOfTheBodiesDoesNotMatter) {
  const Pressed press;
  const BodyDescription ball = body("ball", Primitive(Sphere{press.R})),
                        slab = body("slab", Primitive(Box::fromSize({0.4, 0.4, 0.2})));
  const Isometry3d X_ball = translation({0.12, 0.0, 0.1 + press.R - press.delta}), X_slab = Isometry3d::Identity();
  Monitor one(build({ball, slab}), soft()), other(build({slab, ball}), soft());
  const PairResult ab = one.run(cycle(0.1, {still(X_ball), still(X_slab)}), {}).pairs[0];
  const PairResult ba = other.run(cycle(0.1, {still(X_slab), still(X_ball)}), {}).pairs[0];
  const double size = ab.on_a_W.force.norm();
  EXPECT_GT(size, 1.0);
  EXPECT_LT((ab.on_a_W.force - ba.on_b_W.force).norm(), 1e-9 * size);
  EXPECT_LT((ab.on_a_W.torque - ba.on_b_W.torque).norm(), 1e-9 * size);
  EXPECT_LT((ab.on_b_W.torque - ba.on_a_W.torque).norm(), 1e-9 * size);
  EXPECT_LT((ab.deepest.normal_W + ba.deepest.normal_W).norm(), 1e-9);
}

TEST(MonitorWrench, MomentsAreAboutBothOrigins) {
  const Pressed press;
  const auto scene = build({body("ball", Primitive(Sphere{press.R})), body("ground", ground(), true)}, fine(0.003));
  Monitor monitor(scene, soft());
  const Vector3d p_A(0.4, -0.3, press.R - press.delta);
  const PairResult pair =
      monitor.run(cycle(0.1, {still(translation(p_A)), still(Isometry3d::Identity())}), {}).pairs[0];
  // The contact's centre is below the ball's: no moment about it, and p × F about the ground's origin.
  const Vector3d force(0, 0, press.force());
  EXPECT_LT((pair.on_a_W.force - force).norm(), 0.02 * force.norm());
  EXPECT_LT(pair.on_a_W.torque.norm(), 0.01 * press.R * force.norm());
  EXPECT_LT((pair.on_b_W.torque - p_A.cross(-force)).norm(), 0.02 * force.norm());
}

TEST(MonitorWrench, ActionEqualsReactionAboutOnePoint) {
  Random random(2);
  const auto scene = build({body("a", Primitive(Box::fromSize({0.2, 0.3, 0.1}))),
                            body("b", Primitive(Cylinder::fromRadiusAndLength(0.08, 0.2)))},
                           fine(0.04));
  MonitorOptions options = soft();
  options.contact.damping = 1e5;
  Monitor monitor(scene, options);
  int contacts = 0;
  for (int i = 0; i < 50; ++i) {
    const Isometry3d far = translation({3, 4, 5});
    const CycleMotion motion = cycle(0.1, {{far * pose(random, 3.0, 0.1), far * pose(random, 3.0, 0.1)},
                                           {far * pose(random, 3.0, 0.1), far * pose(random, 3.0, 0.1)}});
    const PairResult& pair = monitor.run(motion, {}).pairs[0];
    contacts += pair.verdict == Verdict::kContact;
    const Vector3d p_A = motion.X_WB[0][1].translation(), p_B = motion.X_WB[1][1].translation();
    const double size = pair.on_a_W.force.norm() + 1.0;
    EXPECT_LT((pair.on_a_W.force + pair.on_b_W.force).norm(), 1e-9 * size);
    const Vector3d about_world =
        pair.on_a_W.torque + p_A.cross(pair.on_a_W.force) + pair.on_b_W.torque + p_B.cross(pair.on_b_W.force);
    EXPECT_LT(about_world.norm(), 1e-9 * size);
  }
  EXPECT_GT(contacts, 25);
}

TEST(MonitorWrench, TheWorldsFrameDoesNotMatter) {
  Random random(4);
  const auto scene = build({body("a", Primitive(Box::fromSize({0.2, 0.3, 0.1}))),
                            body("b", Primitive(Cylinder::fromRadiusAndLength(0.08, 0.2)))},
                           fine(0.04));
  MonitorOptions options = soft();
  options.contact.damping = 1e5;
  Monitor here(scene, options), there(scene, options);
  for (int i = 0; i < 30; ++i) {
    const CycleMotion motion = cycle(
        0.1, {{pose(random, 3.0, 0.2), pose(random, 3.0, 0.2)}, {pose(random, 3.0, 0.2), pose(random, 3.0, 0.2)}});
    const Isometry3d X_VW = pose(random, 3.0, 1000.0);
    CycleMotion moved = motion;
    for (auto& poses : moved.X_WB)
      for (Isometry3d& X : poses) X = X_VW * X;
    const PairResult &a = here.run(motion, {}).pairs[0], &b = there.run(moved, {}).pairs[0];
    ASSERT_EQ(a.verdict, b.verdict);
    const double size = a.on_a_W.force.norm() + 1.0;
    EXPECT_LT((X_VW.linear() * a.on_a_W.force - b.on_a_W.force).norm(), 1e-6 * size);
    EXPECT_LT((X_VW.linear() * a.on_a_W.torque - b.on_a_W.torque).norm(), 1e-6 * size);
    EXPECT_LT((X_VW.linear() * a.on_b_W.torque - b.on_b_W.torque).norm(), 1e-6 * size);
    EXPECT_NEAR(a.deepest.depth, b.deepest.depth, a.deepest.depth_error + b.deepest.depth_error);
  }
}

TEST(MonitorWrench, OverlappingPartsOfABodyPushOnce) {
  const Pressed press;
  BodyDescription block = body("block", Primitive(Box::fromSize({0.14, 0.12, 0.06})), true);
  BodyDescription doubled = block;
  doubled.geometry.push_back(block.geometry[0]);
  doubled.geometry[1].X_BG = translation({0.01, 0, 0});
  const BodyDescription ball = body("ball", Primitive(Sphere{press.R}));
  BodyOptions options = fine(0.003);
  Monitor one(build({block, ball}, options), soft()), two(build({doubled, ball}, options), soft());
  const CycleMotion motion =
      cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, 0.03 + press.R - press.delta}))});
  const double once = one.run(motion, {}).pairs[0].on_b_W.force.z(),
               found = two.run(motion, {}).pairs[0].on_b_W.force.z();
  // The ball's points inside both boxes count once; of the boxes' points, those of the doubled face all remain.
  EXPECT_NEAR(found, 1.5 * once, 0.1 * once);
}

TEST(MonitorWrench, PartsLieWhereTheirBodyPutsThem) {
  // The ground is a part that is upright in its body: it pushes along the body's x.
  BodyDescription wall = body("wall", ground(), true);
  wall.geometry[0].X_BG = pose({0.3, 0.1, 0.2}, kPi / 2.0, {0, 1, 0});
  const Pressed press;
  Monitor monitor(build({wall, body("ball", Primitive(Sphere{press.R}))}, fine(0.003)), soft());
  const Isometry3d X_W_wall = pose({1, 2, 3}, kPi / 2.0, {0, 0, 1});
  const Vector3d p_wall(0.3 + press.R - press.delta, 0.4, -0.2);
  const PairResult& pair =
      monitor.run(cycle(0.1, {still(X_W_wall), still(translation(X_W_wall * p_wall))}), {}).pairs[0];
  EXPECT_NEAR(pair.deepest.depth, press.delta, 2e-4);
  EXPECT_LT((pair.on_b_W.force - Vector3d(0, press.force(), 0)).norm(), 0.02 * press.force());
}

TEST(MonitorWrench, TurntableIsTheSameInOneStepAndInMany) {
  // A ball pressed off-centre onto a rotating table, with damping: force, drag and moment are constant in the world.
  const Pressed press;
  const auto scene = build({body("table", ground()), body("ball", Primitive(Sphere{press.R}))}, fine(0.005));
  MonitorOptions options = soft();
  options.contact.damping = 1e6;
  Monitor coarse(scene, options), dense(scene, options);
  const auto turning = [&](int steps) {
    std::vector<Isometry3d> table;
    for (int i = 0; i <= steps; ++i) table.push_back(pose({5, 5, 5}, 1.0 * i / steps, {0, 0, 1}));
    return cycle(0.1, {table, still(translation({5.3, 5, 5 + press.R - press.delta}), steps + 1)});
  };
  const PairResult &one = coarse.run(turning(1), {true, 1000}).pairs[0], &many = dense.run(turning(50), {}).pairs[0];
  EXPECT_LT((one.on_a_W.force - many.on_a_W.force).norm(), 2e-3 * many.on_a_W.force.norm());
  EXPECT_LT((one.on_a_W.torque - many.on_a_W.torque).norm(), 2e-3 * many.on_a_W.torque.norm());
  EXPECT_LT((one.on_b_W.torque - many.on_b_W.torque).norm(), 2e-3 * many.on_a_W.torque.norm());
  // The table drags the ball along +y and is slowed down by it.
  EXPECT_GT(one.on_b_W.force.y(), 0.1 * press.force());
  EXPECT_LT(one.on_a_W.torque.z(), 0.0);
  EXPECT_NEAR(one.on_b_W.force.z(), press.force(), 0.03 * press.force());
  // Each point is in contact once, all the time, although the path has many chords.
  EXPECT_GT(one.points.size(), 10u);
  EXPECT_LT(one.points.size(), 200u);
  for (const ContactPoint& point : one.points) {
    EXPECT_NEAR(point.enter, 0.0, 1e-12);
    EXPECT_NEAR(point.exit, 0.1, 1e-12);
  }
}

TEST(MonitorWrench, MeshesPressAsTheirShapesDo) {
  const Pressed press;
  BodyOptions sampled = fine(0.004);
  sampled.field.cells = 64;  // for an error below the depth
  const auto scene = build(
      {body("ball", meshShape(icosphere(press.R, 5))), body("block", meshShape(boxMesh({0.07, 0.07, 0.03})), true)},
      sampled);
  for (const auto normal : {NormalSource::kField, NormalSource::kShell}) {
    MonitorOptions options = soft();
    options.contact.normal = normal;
    Monitor monitor(scene, options);
    const Isometry3d X_WA = translation({0.01, 0.02, 0.03 + press.R - press.delta});
    const PairResult& pair = monitor.run(cycle(0.1, {still(X_WA), still(Isometry3d::Identity())}), {}).pairs[0];
    EXPECT_EQ(pair.verdict, Verdict::kContact);
    EXPECT_NEAR(pair.on_a_W.force.z(), press.force(), 0.1 * press.force());
    EXPECT_LT(pair.on_a_W.force.head<2>().norm(), 0.05 * press.force());
  }
}

TEST(MonitorWrench, HundredMetresPerSecondThroughOneMillimetre) {
  // A ball passes through a thin plate within a hundredth of a cycle: damping absorbs k_D times the volume swept by
  // each.
  const double R = 0.02, thickness = 1e-3, T = 0.01, v = 100.0, damping = 1e6;
  const auto scene = build({body("ball", Primitive(Sphere{R})),
                            body("plate", Primitive(Box::fromSize({0.06, 0.06, 2.0 * (thickness / 2)})), true)},
                           fine(0.002));
  MonitorOptions options;
  options.contact.stiffness = 0.0;
  options.contact.damping = damping;
  Monitor monitor(scene, options);
  const PairResult& pair =
      monitor
          .run(
              cycle(T, {{translation({0, 0, 0.47}), translation({0, 0, 0.47 - v * T})}, still(Isometry3d::Identity())}),
              {})
          .pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_FALSE(touchesAtEnds(pair, T));
  // Per unit of area a point is inside for thickness / v, or for the ball's chord / v: the integrals are, over the
  // ball's surface, of the thickness, and over each of the plate's two faces, of the chord, which is the ball's volume.
  // Half of both.
  const double impulse = damping * 0.5 * (4.0 * kPi * R * R * thickness + 2.0 * (4.0 / 3.0) * kPi * R * R * R);
  EXPECT_NEAR(pair.on_a_W.force.z() * T, impulse, 0.03 * impulse);
  EXPECT_NEAR(pair.intervals.front().enter, (0.47 - R - thickness / 2) / v, 1e-5);
  EXPECT_NEAR(pair.intervals.back().exit, (0.47 + R + thickness / 2) / v, 1e-5);
}

/// Two balls of nearly the same size, whose shells are a little more and a little less than the ratio from that on the
/// slab's shell counts less.
TEST(MonitorWrench, DoesNotJumpWhereShellsCeaseToCountAlike) {
  const auto sceneWith = [](double radius) {
    return build({body("ball", Primitive(Sphere{radius})), body("slab", meshShape(boxMesh({0.15, 0.15, 0.0375})))},
                 optionsForContacts());
  };
  const auto ratio = [](const Scene& scene) {
    return scene.bodies[1].shell->covering_radius / scene.bodies[0].shell->covering_radius;
  };
  double low = 0.003, high = 0.04;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (low + high);
    (ratio(*sceneWith(middle)) > 3.0 ? low : high) = middle;
  }
  Monitor larger(sceneWith(low), soft()), smaller(sceneWith(high), soft());
  ASSERT_NEAR(ratio(larger.scene()), ratio(smaller.scene()), 1e-3);
  Random random(5);
  for (int i = 0; i < 40; ++i) {
    const Vector3d place(uniform(random, -0.06, 0.06), uniform(random, -0.06, 0.06), 0.0375 + 0.95 * low);
    const auto force = [&](Monitor& monitor) {
      const CycleMotion motion = cycle(0.1, {still(translation(place)), still(Isometry3d::Identity())});
      return monitor.run(motion, {}).pairs[0].on_a_W.force.z();
    };
    const double expected = force(larger);
    EXPECT_NEAR(force(smaller), expected, 0.05 * expected);
  }
}

}  // namespace sdf_ccd::monitor_wrench_test
