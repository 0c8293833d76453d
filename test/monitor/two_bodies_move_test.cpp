#include <gtest/gtest.h>

#include "oracle/scene_case.h"

namespace sdf_ccd::two_bodies_move_test {

using namespace test;

/// A motion of two bodies, each from one pose to another.
CycleMotion bothMove(const Isometry3d& X_start_a, const Isometry3d& X_end_a, const Isometry3d& X_start_b,
                     const Isometry3d& X_end_b) {
  return cycle(0.1, {{X_start_a, X_end_a}, {X_start_b, X_end_b}});
}

/// Pose of an arm whose joint is at `base`, rotated by `angle` about z.
Isometry3d arm(const Vector3d& base, double angle) {
  return pose(base, angle, Vector3d::UnitZ());
}

/// Two arms of 0.8 m whose joints are 1.66 m apart. Both rotate by the same angle between two poses; halfway each hand
/// (a ball of 5 cm radius at the arm's end) is on the line between the joints, so the hands meet, whatever the relative
/// poses at both ends are.
TEST(TwoBodiesMove, HandsThatMeetHalfwayAreFound) {
  const auto hand = [](const std::string& name) {
    BodyDescription description = body(name, Primitive(Sphere{0.05}));
    description.geometry[0].X_BG = translation({0.8, 0.0, 0.0});
    return description;
  };
  const auto scene = build({hand("left"), hand("right")}, fine(0.005));
  const Vector3d left(0.0, 0.0, 0.0), right(1.66, 0.0, 0.0);
  for (const double turn : {0.25, 0.5, 1.0, 2.0, 3.0}) {
    Monitor monitor(scene, {});
    const PairResult& pair = monitor
                                 .run(bothMove(arm(left, -0.5 * turn), arm(left, 0.5 * turn),
                                               arm(right, M_PI + 0.5 * turn), arm(right, M_PI - 0.5 * turn)),
                                      {})
                                 .pairs[0];
    ASSERT_EQ(pair.verdict, Verdict::kContact) << turn;
    // The hands' centres are 1.66 - 1.6 cos(angle) apart, at least 0.06.
    EXPECT_NEAR(pair.deepest.depth, 0.04, pair.contact_error.total()) << turn;
    EXPECT_NEAR(pair.deepest.time, 0.05, 0.01) << turn;
  }
}

/// The same arms side by side: their screw motions in the world cross, a screw of their relative pose does not.
TEST(TwoBodiesMove, ArmsThatCrossBetweenTheirPosesAreNotClear) {
  const auto scene = build({body("left", Primitive(Box::fromSize({0.8, 0.04, 0.04}))),
                            body("right", Primitive(Box::fromSize({0.8, 0.04, 0.04})))},
                           fine(0.004));
  int met = 0;
  for (int i = 0; i < 40; ++i) {
    // Both swing through: what they do in between is not visible in either pose.
    const double offset = 0.02 * i;
    const auto at = [&](double x, double angle) {
      return Isometry3d(arm({x, 0.0, 0.0}, angle) * translation({0.4, 0.0, 0.0}));
    };
    const Isometry3d a0 = at(0.0, 1.0), a1 = at(0.0, -1.0), b0 = at(1.0 + offset, M_PI - 1.0),
                     b1 = at(1.0 + offset, M_PI + 1.0);
    Monitor monitor(scene, {});
    const PairResult& pair = monitor.run(bothMove(a0, a1, b0, b1), {}).pairs[0];
    // Halfway both lie on the line between the joints, and overlap if these are less than 1.6 m apart.
    if (1.0 + offset >= 1.6) continue;
    ++met;
    EXPECT_EQ(pair.verdict, Verdict::kContact) << offset;
  }
  EXPECT_GT(met, 20);
}

/// Links that rotate by +2 and -2 rad about one axis rotate by 4 rad relative to each other, not by 2.28 in reverse.
TEST(TwoBodiesMove, RelativeTurnsBeyondHalfARevolutionAreNotTakenTheShortWay) {
  const auto scene = build({body("plate", Primitive(Box::fromSize({0.1, 0.1, 0.1}))),
                            body("rod", Primitive(Box::fromSize({0.1, 0.1, 0.1})))},
                           fine(0.005));
  // Both on a circle of 0.5 m, exchanging places: they meet halfway through 4 rad, but would not within 2.28.
  const auto on_circle = [](double angle) {
    return Isometry3d(arm(Vector3d::Zero(), angle) * translation({0.5, 0.0, 0.0}));
  };
  Monitor monitor(scene, {});
  const PairResult& pair =
      monitor.run(bothMove(on_circle(0.0), on_circle(2.0), on_circle(2.0), on_circle(0.0)), {}).pairs[0];
  EXPECT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_NEAR(pair.deepest.time, 0.05, 0.01);
  Monitor apart(scene, {});
  EXPECT_EQ(apart.run(bothMove(on_circle(0.0), on_circle(2.0), on_circle(-0.5), on_circle(-2.5)), {}).pairs[0].verdict,
            Verdict::kClear);
}

TEST(TwoBodiesMove, BodiesOnOneMovingBaseAreSkippedAsIfTheyStood) {
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, fine(0.02));
  Monitor monitor(scene, {});
  const auto base = [](double s) { return pose({s, 0.5 * s, 0.0}, 0.7 * s, Vector3d(1.0, 2.0, 3.0)); };
  for (int i = 0; i < 20; ++i) {
    const double s = 0.1 * i;
    const Isometry3d X_b = translation({0.3, 0.0, 0.0});
    const PairResult& pair =
        monitor.run(bothMove(base(s), base(s + 0.1), base(s) * X_b, base(s + 0.1) * X_b), {}).pairs[0];
    EXPECT_EQ(pair.verdict, Verdict::kClear);
    EXPECT_EQ(pair.skipped, i > 0);
  }
}

/// Both on one rotating base, so that they move little relative to each other: their contact rotates with them.
TEST(TwoBodiesMove, AContactIsWhereTheBodiesAreInTheWorld) {
  const auto scene = build(
      {body("plate", Primitive(Box::fromSize({0.4, 0.4, 0.04}))), body("ball", Primitive(Sphere{0.1}))}, fine(0.01));
  const auto base = [](double s) { return pose(Vector3d::Zero(), 2.0 * s, Vector3d::UnitZ()); };
  const auto ball = [&](double s) { return Isometry3d(base(s) * translation({1.0, 0.0, 0.11})); };
  const auto plate = [&](double s) { return Isometry3d(base(s) * translation({1.0, 0.0, 0.0})); };
  Monitor monitor(scene, {});
  const PairResult& pair = monitor.run(bothMove(plate(0.0), plate(1.0), ball(0.0), ball(1.0)), {true, 10}).pairs[0];
  ASSERT_EQ(pair.verdict, Verdict::kContact);
  for (const ContactPoint& point : pair.points) {
    const Vector3d p_base = base(point.time / 0.1).inverse() * point.p_W;
    EXPECT_LT((p_base - Vector3d(1.0, 0.0, p_base.z())).norm(), 0.05);
    EXPECT_NEAR(p_base.z(), 0.015, 0.006);
  }
  // The force on the ball points upwards all the time, except for the irregularity of the points.
  EXPECT_LT(pair.on_b_W.force.head<2>().norm(), 1e-2 * pair.on_b_W.force.norm());
}

TEST(TwoBodiesMove, RotationsThatAreNoneToRoundingAndFarCoordinatesStandInTheBound) {
  const auto scene = build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1}))}, fine(0.02));
  const auto chordError = [&](const Isometry3d& X_a, const Isometry3d& X_b) {
    Monitor monitor(scene, {});
    return monitor.run(bothMove(X_a, X_a, X_b, X_b), {}).pairs[0].error.chord;
  };
  const Isometry3d X_a = Isometry3d::Identity(), X_b = translation({1.0, 0.0, 0.0});
  EXPECT_LT(chordError(X_a, X_b), 1e-13);
  Isometry3d skewed = X_b;
  skewed.linear()(0, 1) += 4e-7;
  EXPECT_GT(chordError(X_a, skewed), 4e-8);  // of the ball's radius
  EXPECT_GT(chordError(skewed, X_a), 4e-7);  // of the other body's distance
  const Vector3d far(5e7, 0.0, 0.0);
  EXPECT_GT(chordError(translation(far) * X_a, translation(far) * X_b), 1e-8);
}

TEST(TwoBodiesMove, AHalfSpaceStraysMoreFarFromItsOrigin) {
  const auto scene = build({body("ground", ground()), body("ball", Primitive(Sphere{0.1}))}, fine(0.02));
  for (const double distance : {1.0, 5.0, 100.0}) {
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({distance, 0.0, 0.15}))});
    motion.motion_error = {1e-3, 0.0};
    Monitor monitor(scene, {});
    EXPECT_NEAR(monitor.run(motion, {}).pairs[0].error.chord, std::max(1e-3, 1e-4 * distance), 1e-4) << distance;
  }
}

/// A robot's own voxels in a depth camera's map: they touch no surface of the link that contains them.
TEST(WhollyInside, AVoxelInTheMiddleOfALinkIsAContact) {
  for (const int voxels : {1, 2, 5}) {
    TriangleMesh map;
    for (int i = 0; i < voxels; ++i) {  // all but the last one far from the link
      const Vector3d at(i + 1 < voxels ? 3.0 + 0.2 * i : 0.0, 0.0, 0.0);
      map = merged(map,
                   transformed(tessellate(Primitive(Box::fromSize(Vector3d::Constant(0.05))), 0.1), translation(at)));
    }
    BodyDescription octomap = body("octomap", meshShape(map), true);
    octomap.geometry[0].watertight_voxels = true;
    octomap.geometry[0].cell_size = 0.0125;
    for (const bool mesh : {false, true}) {
      const Primitive box = Box::fromSize({0.4, 0.4, 0.4});
      BodyOptions options = fine(0.01);
      const auto scene = build({body("link", mesh ? meshShape(tessellate(box, 0.01)) : Shape(box)), octomap}, options);
      for (const double way : {0.0, 0.12}) {
        Monitor monitor(scene, {});
        const auto run = [&](double x) {
          return monitor
              .run(cycle(0.1, {{translation({x, 0, 0}), translation({x + way, 0, 0})}, still(Isometry3d::Identity())}),
                   {})
              .pairs[0];
        };
        const PairResult inside = run(-0.5 * way);
        EXPECT_EQ(inside.verdict, Verdict::kContact) << voxels << " voxels, moved by " << way;
        EXPECT_GT(inside.deepest.depth + inside.deepest.depth_error, 0.1);
        EXPECT_EQ(run(1.0).verdict, Verdict::kClear);
        EXPECT_EQ(run(0.0).verdict, Verdict::kContact);  // back without a path: the clearance does not count
      }
    }
  }
}

TEST(DelayedPairs, ACycleWithThemIsNotClearAsAWhole) {
  const auto scene =
      build({body("a", Primitive(Sphere{0.1})), body("b", Primitive(Sphere{0.1})), body("c", Primitive(Sphere{0.1}))},
            fine(0.02));
  Monitor monitor(scene, {});
  CycleMotion motion =
      cycle(0.1, {still(Isometry3d::Identity()), still(translation({1, 0, 0})), still(translation({2, 0, 0}))});
  EXPECT_EQ(monitor.run(motion, {}).verdict, Verdict::kClear);
  motion.spans = {{0, 1}, {0, 0}, {0, 0}};
  EXPECT_EQ(monitor.run(motion, {}).verdict, Verdict::kNotChecked);
  EXPECT_EQ(monitor.run(motion, {}).delayed, 2);
  motion.X_WB[1] = still(translation({0.1, 0, 0}));
  EXPECT_EQ(monitor.run(motion, {}).verdict, Verdict::kContact);
}

}  // namespace sdf_ccd::two_bodies_move_test
