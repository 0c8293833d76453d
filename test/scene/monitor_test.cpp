#include "sdf_ccd/scene/monitor.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <stdexcept>

#include "scene/scene_case.h"

namespace sdf_ccd {
namespace {

using namespace test;

constexpr double kStiffness = 1e7;

MonitorOptions soft() {
  MonitorOptions options;
  options.contact.stiffness = kStiffness;
  return options;
}

TEST(Monitor, GivesAllFourVerdicts) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.02));
  Monitor monitor(scene, soft());
  const auto verdictAt = [&](double height) {
    monitor.reset();
    return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, height}))}), {});
  };
  const double gap = scene->bodies[1].shell.covering_radius;
  EXPECT_EQ(verdictAt(0.1 + 1.2 * gap).verdict, Verdict::kClear);
  EXPECT_EQ(verdictAt(0.1 + 0.5 * gap).verdict, Verdict::kUncertain);
  EXPECT_EQ(verdictAt(0.095).verdict, Verdict::kContact);
  CycleMotion lost = cycle(0.1, {still(Isometry3d::Identity()), {}});
  lost.missing = {"", "no transform from ball to world"};
  const CycleResult& result = monitor.run(lost, {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_EQ(result.pairs[0].reason, lost.missing[1]);
  EXPECT_EQ(result.not_checked, 1);
}

TEST(Monitor, FindsContactBetweenTheSamples) {
  const auto scene = build(
      {body("plate", Primitive(Box{{0.05, 0.05, 0.0005}}), true), body("ball", Primitive(Sphere{0.02}))}, fine(0.004));
  Monitor monitor(scene, soft());
  // Through the plate from above to below within one cycle.
  const CycleResult& result = monitor.run(
      cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, 0.1}), translation({0, 0, -0.1})}}), {true, 5});
  const PairResult& pair = result.pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_FALSE(pair.touches_at_sample);
  ASSERT_EQ(pair.intervals.size(), 1u);
  EXPECT_NEAR(pair.intervals[0].enter, 0.1 * (0.1 - 0.0205) / 0.2, 1e-3);
  EXPECT_NEAR(pair.intervals[0].exit, 0.1 * (0.1 + 0.0205) / 0.2, 1e-3);
  EXPECT_EQ(pair.points.size(), 5u);
  EXPECT_EQ(pair.points[0].depth, pair.deepest.depth);
  EXPECT_GT(pair.deepest.depth, 0.9e-2);  // the plate's points in the ball
}

TEST(Monitor, SeesWhatASampleSees) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const auto fall = [&](double from, double to) {
    return monitor
        .run(cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, from}), translation({0, 0, to})}}), {})
        .pairs[0]
        .touches_at_sample;
  };
  EXPECT_TRUE(fall(0.3, 0.09));
  EXPECT_TRUE(fall(0.09, 0.3));
  EXPECT_FALSE(fall(0.3, 0.2));
}

/// A ball pressed δ into a plate; the same for both orders of bodies, wherever in the world.
struct Pressed {
  double R = 0.1, delta = 0.005;
  double force() const { return kPi * kStiffness * R * delta * delta; }
};

TEST(Monitor, BothRolesDoNotDouble) {
  const Pressed press;
  const auto scene = build(
      {body("ball", Primitive(Sphere{press.R})), body("block", Primitive(Box{{0.07, 0.07, 0.03}}), true)}, fine(0.003));
  Monitor monitor(scene, soft());
  const Isometry3d X_WA = translation({0.02, 0.03, 0.03 + press.R - press.delta});
  const PairResult pair = monitor.run(cycle(0.1, {still(X_WA), still(Isometry3d::Identity())}), {}).pairs[0];
  EXPECT_NEAR(pair.on_a_W.force.z(), press.force(), 0.05 * press.force());
  EXPECT_LT((pair.on_a_W.force + pair.on_b_W.force).norm(), 1e-9 * press.force());
  EXPECT_GT(pair.deepest.normal_W.z(), -1.0 - 1e-9);
  EXPECT_LT(pair.deepest.normal_W.z(), -0.9);  // from A, above, to B
}

TEST(Monitor, OrderOfTheBodiesDoesNotMatter) {
  const Pressed press;
  const BodyDescription ball = body("ball", Primitive(Sphere{press.R})),
                        slab = body("slab", Primitive(Box{{0.2, 0.2, 0.1}}));
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

TEST(Monitor, MomentsAreAboutBothOrigins) {
  const Pressed press;
  const auto scene = build({body("ball", Primitive(Sphere{press.R})), body("ground", ground(), true)}, fine(0.003));
  Monitor monitor(scene, soft());
  const Vector3d p_A(0.4, -0.3, press.R - press.delta);
  const PairResult pair =
      monitor.run(cycle(0.1, {still(translation(p_A)), still(Isometry3d::Identity())}), {}).pairs[0];
  // The contact's centre lies below the ball's: no moment about it, p × F about the ground's origin.
  const Vector3d force(0, 0, press.force());
  EXPECT_LT((pair.on_a_W.force - force).norm(), 0.02 * force.norm());
  EXPECT_LT(pair.on_a_W.torque.norm(), 0.01 * press.R * force.norm());
  EXPECT_LT((pair.on_b_W.torque - p_A.cross(-force)).norm(), 0.02 * force.norm());
}

TEST(Monitor, ActionEqualsReactionAboutOnePoint) {
  std::mt19937 random(2);
  const auto scene =
      build({body("a", Primitive(Box{{0.1, 0.15, 0.05}})), body("b", Primitive(Cylinder{0.08, 0.1}))}, fine(0.04));
  MonitorOptions options = soft();
  options.contact.damping = 1e5;
  Monitor monitor(scene, options);
  int contacts = 0;
  for (int i = 0; i < 50; ++i) {
    const Isometry3d far = translation({3, 4, 5});
    const CycleMotion motion = cycle(0.1, {{far * randomPose(random, 0.1), far * randomPose(random, 0.1)},
                                           {far * randomPose(random, 0.1), far * randomPose(random, 0.1)}});
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

TEST(Monitor, TheWorldsFrameDoesNotMatter) {
  std::mt19937 random(4);
  const auto scene =
      build({body("a", Primitive(Box{{0.1, 0.15, 0.05}})), body("b", Primitive(Cylinder{0.08, 0.1}))}, fine(0.04));
  MonitorOptions options = soft();
  options.contact.damping = 1e5;
  Monitor here(scene, options), there(scene, options);
  for (int i = 0; i < 30; ++i) {
    const CycleMotion motion = cycle(
        0.1, {{randomPose(random, 0.2), randomPose(random, 0.2)}, {randomPose(random, 0.2), randomPose(random, 0.2)}});
    const Isometry3d X_VW = randomPose(random, 1000.0);
    CycleMotion moved = motion;
    for (auto& poses : moved.X_WB)
      for (Isometry3d& X : poses) X = X_VW * X;
    const PairResult &a = here.run(motion, {}).pairs[0], &b = there.run(moved, {}).pairs[0];
    ASSERT_EQ(a.verdict, b.verdict);
    const double size = a.on_a_W.force.norm() + 1.0;
    EXPECT_LT((X_VW.linear() * a.on_a_W.force - b.on_a_W.force).norm(), 1e-6 * size);
    EXPECT_LT((X_VW.linear() * a.on_a_W.torque - b.on_a_W.torque).norm(), 1e-6 * size);
    EXPECT_LT((X_VW.linear() * a.on_b_W.torque - b.on_b_W.torque).norm(), 1e-6 * size);
    EXPECT_NEAR(a.deepest.depth, b.deepest.depth, 1e-9);
  }
}

TEST(Monitor, QuarterTurnWithinOneCycle) {
  // A bar swings through a post that it meets neither before nor after.
  BodyDescription bar = body("bar", Primitive(Box{{0.25, 0.02, 0.02}}));
  bar.geometry[0].X_BG = translation({0.35, 0, 0});
  const auto scene = build({body("post", Primitive(Cylinder{0.03, 0.2}), true), bar});
  Monitor monitor(scene, soft());
  const Isometry3d post = translation({0.3, 0.3, 0});
  const CycleMotion swing = cycle(0.1, {still(post), {Isometry3d::Identity(), pose({0, 0, 0}, kPi / 2, {0, 0, 1})}});
  const PairResult& pair = monitor.run(swing, {}).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_FALSE(pair.touches_at_sample);
  EXPECT_LT(pair.error.chord, 2e-4);
  // The chord of the bar's tip passes inside of the arc: a straight path would give other times.
  const double half_angle = std::asin((0.03 + 0.02) / (0.3 * std::sqrt(2.0)));
  ASSERT_EQ(pair.intervals.size(), 1u);
  EXPECT_NEAR(pair.intervals[0].enter, 0.1 * (0.5 - half_angle / (kPi / 2)), 1e-3);
  EXPECT_NEAR(pair.intervals[0].exit, 0.1 * (0.5 + half_angle / (kPi / 2)), 1e-3);
}

TEST(Monitor, OverlappingPartsOfABodyPushOnce) {
  const Pressed press;
  BodyDescription block = body("block", Primitive(Box{{0.07, 0.06, 0.03}}), true);
  BodyDescription doubled = block;
  doubled.geometry.push_back(block.geometry[0]);
  doubled.geometry[1].X_BG = translation({0.01, 0, 0});
  const BodyDescription ball = body("ball", Primitive(Sphere{press.R}));
  SceneOptions options = fine(0.003);
  Monitor one(build({block, ball}, options), soft()), two(build({doubled, ball}, options), soft());
  const CycleMotion motion =
      cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, 0.03 + press.R - press.delta}))});
  const double once = one.run(motion, {}).pairs[0].on_b_W.force.z(),
               found = two.run(motion, {}).pairs[0].on_b_W.force.z();
  // The ball's points in the two boxes count once; of the boxes' points the doubled face's stay.
  EXPECT_NEAR(found, 1.5 * once, 0.1 * once);
}

TEST(Monitor, ResultsDoNotDependOnThreads) {
  std::mt19937 random(9);
  std::vector<BodyDescription> bodies;
  for (int i = 0; i < 6; ++i) bodies.push_back(body("b" + std::to_string(i), Primitive(Box{{0.1, 0.08, 0.05}})));
  const auto scene = build(bodies, fine(0.02));
  Monitor one(scene, soft()), two(scene, soft());
  for (int i = 0; i < 10; ++i) {
    std::vector<std::vector<Isometry3d>> poses;
    for (int b = 0; b < 6; ++b) {
      const Isometry3d X = randomPose(random, 0.25);
      poses.push_back({X, X * pose({0.05, 0, 0}, 0.3, {1, 1, 0})});
    }
    const CycleMotion motion = cycle(0.1, poses);
    const auto runWith = [&](Monitor& monitor, std::size_t threads) -> const CycleResult& {
      const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      return monitor.run(motion, {true, 3});
    };
    const CycleResult &a = runWith(one, 1), &b = runWith(two, 2);
    for (std::size_t p = 0; p < a.pairs.size(); ++p) {
      ASSERT_EQ(a.pairs[p].verdict, b.pairs[p].verdict);
      ASSERT_EQ(a.pairs[p].on_a_W.force, b.pairs[p].on_a_W.force);
      ASSERT_EQ(a.pairs[p].on_b_W.torque, b.pairs[p].on_b_W.torque);
      ASSERT_EQ(a.pairs[p].deepest.p_W, b.pairs[p].deepest.p_W);
      ASSERT_EQ(a.pairs[p].points.size(), b.pairs[p].points.size());
    }
  }
}

TEST(Monitor, WithoutSubscribersNoWrenchAndNoPoints) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, 0.09}))});
  const PairResult pair = monitor.run(motion, {false, 0}).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_EQ(pair.on_a_W.force, Vector3d::Zero());
  EXPECT_TRUE(pair.points.empty());
  EXPECT_NEAR(pair.deepest.depth, 0.01, 1e-3);
}

TEST(Monitor, BoundBeyondTheBandNeverMakesClear) {
  // Only a sampled field, with a narrow band, and a motion that is known to 20 cm.
  BodyDescription map = body("map", meshShape(boxMesh({0.1, 0.1, 0.1})), true);
  map.geometry[0].watertight_voxels = true;
  const auto scene = build({map, body("ball", Primitive(Sphere{0.05}))});
  Monitor monitor(scene, soft());
  const auto verdictAt = [&](double distance) {
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({0.15 + distance, 0, 0}))});
    motion.motion_error = {0.1, 0.1};
    monitor.reset();
    return monitor.run(motion, {}).verdict;
  };
  ASSERT_LT(scene->bodies[0].parts[0].field.band(), 0.05);
  EXPECT_EQ(verdictAt(0.1), Verdict::kUncertain);
  EXPECT_EQ(verdictAt(0.19), Verdict::kUncertain);
  EXPECT_EQ(verdictAt(0.3), Verdict::kClear);
}

TEST(Monitor, MotionErrorsOfBothBodiesCount) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, soft());
  const auto run = [&](double height, double angle) -> const PairResult& {
    const Isometry3d X = translation({0, 0, height});
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), {X, X * pose({0, 0, 0}, angle, {1, 0, 0})}});
    motion.motion_error = {0.01, 0.02};
    monitor.reset();
    return monitor.run(motion, {}).pairs[0];
  };
  EXPECT_EQ(run(0.075, 0.0).verdict, Verdict::kUncertain);  // 25 mm deep, known to 30 mm
  EXPECT_EQ(run(0.065, 0.0).verdict, Verdict::kContact);
  EXPECT_EQ(run(0.135, 0.0).verdict, Verdict::kUncertain);
  EXPECT_EQ(run(0.145, 0.0).verdict, Verdict::kClear);
  const double chord = run(0.1, 1.0).error.chord;
  EXPECT_GT(chord, 0.03 + 1e-6);
  EXPECT_LE(chord, 0.03 + 1e-4);
}

TEST(Monitor, PartsLieWhereTheirBodyPutsThem) {
  // The ground is a part that stands upright in its body: it pushes along the body's x.
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

TEST(Monitor, TurntableIsTheSameInOneStepAndInMany) {
  // A ball pressed off-centre onto a turning table, with damping: force, drag and moment are constant in the world.
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
  // The table drags the ball along +y and is braked by it.
  EXPECT_GT(one.on_b_W.force.y(), 0.1 * press.force());
  EXPECT_LT(one.on_a_W.torque.z(), 0.0);
  EXPECT_NEAR(one.on_b_W.force.z(), press.force(), 0.03 * press.force());
  // Each point is in contact once, all the time, though the path has many chords.
  EXPECT_GT(one.points.size(), 10u);
  EXPECT_LT(one.points.size(), 200u);
  for (const ContactPoint& point : one.points) {
    EXPECT_NEAR(point.enter, 0.0, 1e-12);
    EXPECT_NEAR(point.exit, 0.1, 1e-12);
  }
}

TEST(Monitor, ClearanceAllowsForTheGapsBetweenPoints) {
  Scene scene = *build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))});
  scene.bodies[1].shell.covering_radius = 0.2;
  Monitor monitor(std::make_shared<const Scene>(scene), soft());
  for (const double height : {2.0, 0.35}) {  // from the ball alone, and from the points
    monitor.reset();
    const PairResult& pair =
        monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(translation({0, 0, height}))}), {}).pairs[0];
    ASSERT_EQ(pair.verdict, Verdict::kClear);
    EXPECT_LE(pair.clearance, height - 0.1 - 0.2 + 1e-3);
    EXPECT_GT(pair.clearance, height - 0.1 - 0.2 - 0.15);
  }
}

TEST(Monitor, RefusesMotionsThatDoNotFit) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.05));
  Monitor monitor(scene, {});
  const auto still2 = still(Isometry3d::Identity());
  EXPECT_THROW(monitor.run(cycle(0.1, {still2}), {}), std::invalid_argument);
  EXPECT_THROW(monitor.run(cycle(0.1, {still2, {}}), {}), std::invalid_argument);
  EXPECT_THROW(monitor.run(cycle(-0.1, {still2, still2}), {}), std::invalid_argument);
  CycleMotion bad = cycle(0.1, {still2, still2});
  bad.X_WB[1][1].translation().x() = std::nan("");
  const CycleResult& result = monitor.run(bad, {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  EXPECT_FALSE(result.pairs[0].reason.empty());
  EXPECT_THROW(Monitor(nullptr, {}), std::invalid_argument);
  MonitorOptions options;
  options.chords.tolerance = 0.0;
  EXPECT_THROW(Monitor(scene, options), std::invalid_argument);
}

TEST(NearestBody, FindsTheNearestAndItsGradient) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.05));
  // Only the ground's field is planned: the ball is ever a shell.
  const std::vector<Isometry3d> X_WB = {pose({0, 0, -1}, kPi / 2, {0, 1, 0}), Isometry3d::Identity()};
  const NearestBody nearest = nearestBody(*scene, X_WB, {0.7, 0.2, 0.3});
  EXPECT_EQ(nearest.body, 0);
  EXPECT_NEAR(nearest.distance, 0.7, 1e-12);
  EXPECT_LT((nearest.gradient_W - Vector3d::UnitX()).norm(), 1e-12);

  const auto two = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, fine(0.05));
  const NearestBody other = nearestBody(*two, {translation({0, 0, 0}), translation({1, 0, 0})}, {0.8, 0, 0});
  EXPECT_EQ(other.body, 1);
  EXPECT_NEAR(other.distance, 0.1, 1e-12);
  EXPECT_EQ(nearestBody(Scene{}, {}, {0, 0, 0}).body, -1);
}

}  // namespace
}  // namespace sdf_ccd
