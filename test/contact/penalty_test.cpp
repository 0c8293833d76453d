#include "contact/penalty.h"

#include <numeric>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "oracle/contact_case.h"
#include "oracle/random.h"
#include "shell/point_shell.h"

namespace sdf_ccd::penalty_test {

using namespace test;

ContactOptions onlyDamping(double damping) {
  ContactOptions options;
  options.stiffness = 0.0;
  options.damping = damping;
  return options;
}

TEST(Penalty, SphereOnPlaneHasClosedFormsWhateverTheSpacing) {
  const double R = 0.1, delta = 0.004, T = 0.02;
  const Isometry3d X_FP = translation({0, 0, R - delta});
  for (const int count : {20000, 80000}) {
    const ContactCase pressed{DistanceField(ground()), spiralSphere(R, count), oneChord(T, X_FP, X_FP)};
    ContactOptions options = perArea();
    const Vector3d field_normals = pressed.run(options).on_shell_body.force / T;
    options.normal = NormalSource::kShell;
    const Vector3d shell_normals = pressed.run(options).on_shell_body.force / T;
    const double with_field = kPi * kStiffness * R * delta * delta;
    const double with_shell = kPi * kStiffness * delta * delta * (R - delta / 3.0);
    EXPECT_NEAR(field_normals.z(), with_field, 2e-3 * with_field) << count;
    EXPECT_NEAR(shell_normals.z(), with_shell, 2e-3 * with_shell) << count;
    EXPECT_LT(field_normals.head<2>().norm(), 1e-9 * with_field);
    EXPECT_LT(shell_normals.head<2>().norm(), 2e-2 * with_field);
  }
}

TEST(Penalty, BoxFlatOnPlaneCarriesAreaTimesDepth) {
  const double delta = 0.002, half = 0.05, T = 0.01;
  const Vector3d place(0.3, -0.2, -delta);
  const Isometry3d X_FP = translation(place);
  for (const int count : {1, 5, 40}) {
    const ContactCase pressed{DistanceField(ground()), bottomFace(half, count), oneChord(T, X_FP, X_FP)};
    const Wrench w = pressed.run(perArea()).on_shell_body;
    const Vector3d force(0, 0, kStiffness * 4.0 * half * half * delta);
    EXPECT_LT((w.force / T - force).norm(), 1e-7 * force.norm()) << count;
    EXPECT_LT((w.torque / T - place.cross(force)).norm(), 1e-7 * force.norm()) << count;
  }
}

TEST(Penalty, StiffnessPerPointGrowsWithThePoints) {
  ContactOptions options = perArea();
  options.stiffness_per = StiffnessPer::kPoint;
  options.stiffness = 500.0;
  const Isometry3d X_FP = translation({0, 0, -0.002});
  const ContactCase pressed{DistanceField(ground()), bottomFace(0.05, 6), oneChord(2.0, X_FP, X_FP)};
  EXPECT_NEAR(pressed.run(options).on_shell_body.force.z(), 2.0 * 36 * 500.0 * 0.002, 1e-9);
}

TEST(Penalty, OffCentreContactTurnsTheBody) {
  const Isometry3d X_FP = translation({0.5, 0.0, -0.001});
  const ContactCase pressed{DistanceField(ground()), onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                            oneChord(1.0, X_FP, X_FP)};
  // An upward force at +x has a torque about -y.
  EXPECT_NEAR(pressed.run(perArea()).on_shell_body.torque.y(), -0.5 * kStiffness * 0.001, 1e-9);
}

TEST(Penalty, PartOfACycleCountsForThatPart) {
  // Falls at v from height h: d = h − v t, in contact from h / v to T.
  const double h = 0.03, v = 2.0, T = 0.05;
  const ContactCase falling{DistanceField(ground()), onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                            oneChord(T, translation({0, 0, h}), translation({0, 0, h - v * T}))};
  const double inside = T - h / v;
  const ContactImpulse result = falling.run(perArea());
  EXPECT_NEAR(result.on_shell_body.force.z(), kStiffness * v * inside * inside / 2.0, 1e-6);
  ASSERT_EQ(result.depths.size(), 1u);
  EXPECT_NEAR(result.depths[0].depth, v * T - h, 1e-8);
  EXPECT_NEAR(result.depths[0].time, T, 1e-9);
}

TEST(Penalty, HundredMetresPerSecondThroughOneMillimetre) {
  const double v = 100.0, thickness = 1e-3, T = 0.01;
  const DistanceField plate(Box::fromSize({0.4, 0.4, thickness}));
  const Vector3d velocity(0, 0, -v);
  const ContactCase passing{plate, onePoint({0.01, 0.02, 0.0}, -Vector3d::UnitZ()),
                            oneChord(T, translation({0, 0, 0.43}), translation(Vector3d(0, 0, 0.43) + T * velocity))};
  ContactOptions options = perArea();
  options.normal = NormalSource::kShell;
  // The depth rises linearly to half the thickness and falls again: a triangle of duration thickness / v.
  const double one_way = kStiffness * thickness * thickness / (4.0 * v);
  EXPECT_NEAR(passing.run(options).on_shell_body.force.z(), one_way, 1e-6 * one_way);
  // The field pushes out on the nearer side, so that the two halves cancel.
  options.normal = NormalSource::kField;
  EXPECT_NEAR(passing.run(options).on_shell_body.force.z(), 0.0, 1e-6 * one_way);
  const Wrench damping = passing.run(onlyDamping(3.0)).on_shell_body;
  EXPECT_NEAR(damping.force.z(), 3.0 * thickness, 1e-8);
  const HitDepth deepest = passing.run(options).depths.at(0);
  EXPECT_NEAR(deepest.depth, thickness / 2.0, 1e-6);
  EXPECT_NEAR(deepest.time, 0.43 / v, 1e-8);
}

TEST(Penalty, FrameOfIntegrationOnlyTurnsTheWrench) {
  Random random(3);
  ContactOptions options = perArea();
  options.damping = 1e4;
  for (int i = 0; i < 20; ++i) {
    const Isometry3d turn = pose(random, 3.0, 1.0), X_CF0 = pose(random, 3.0, 1.0), X_CF1 = pose(random, 3.0, 1.0);
    ContactCase moving{DistanceField(Box::fromSize({0.6, 0.4, 0.2})),
                       spiralSphere(0.2, 300),
                       oneChord(0.3, pose({0.4, 0, 0.1}, 0.3, {1, 2, 3}), pose({0.2, 0.1, 0.1}, 0.9, {1, 2, 3})),
                       {X_CF0, X_CF1}};
    const Wrench before = moving.run(options).on_shell_body;
    moving.X_CF = {turn * X_CF0, turn * X_CF1};
    const Wrench after = expressedIn(turn, moving.run(options).on_shell_body);
    EXPECT_GT(before.force.norm(), 1.0);
    EXPECT_LT((after.force - before.force).norm(), 1e-9 * before.force.norm());
    EXPECT_LT((after.torque - before.torque).norm(), 1e-9 * before.force.norm());
  }
}

TEST(Penalty, FrameOfTheShellDoesNotMatter) {
  Random random(5);
  ContactCase moving{DistanceField(Box::fromSize({0.6, 0.4, 0.2})), spiralSphere(0.2, 300),
                     oneChord(0.3, translation({0.4, 0, 0.1}), translation({0.2, 0.1, 0.1}))};
  const Wrench before = moving.run(perArea()).on_shell_body;
  const Isometry3d X_PQ = pose(random, 3.0, 1.0);
  const PointShell of_p = std::exchange(moving.shell, {});
  for (std::size_t i = 0; i < of_p.size(); ++i)
    moving.shell.add(X_PQ.inverse() * of_p.point(i), X_PQ.linear().transpose() * of_p.normal(i), of_p.areas[i]);
  moving.path.chords[0].X_FP_start = moving.path.chords[0].X_FP_start * X_PQ;
  moving.path.chords[0].X_FP_end = moving.path.chords[0].X_FP_end * X_PQ;
  const Wrench after = moving.run(perArea()).on_shell_body;
  // A point's depth changes by at most the error of its new position, and so does its lever, which is below 1 m. No
  // point is that near to where the box's normal jumps.
  const double area = std::accumulate(of_p.areas.begin(), of_p.areas.end(), 0.0), error = moving.shell.position_error;
  const double of_depth = kStiffness * area * error;
  EXPECT_LT((after.force - before.force).norm(), of_depth + 1e-9 * before.force.norm());
  EXPECT_LT((after.torque - before.torque).norm(), of_depth + (error + 1e-9) * before.force.norm());
}

TEST(Penalty, TurningBodiesTurnTheForceWithThem) {
  // Pressed together while both rotate by a quarter revolution about y: the mean force is 2/π along both axes.
  const Isometry3d X_FP = translation({0, 0, -0.001});
  const ContactCase turning{DistanceField(ground()),
                            onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                            oneChord(1.0, X_FP, X_FP),
                            {Isometry3d::Identity(), pose(Vector3d::Zero(), kPi / 2.0, Vector3d::UnitY())}};
  const Vector3d force = turning.run(perArea()).on_shell_body.force / (kStiffness * 0.001);
  EXPECT_LT((force - Vector3d(2.0 / kPi, 0, 2.0 / kPi)).norm(), 1e-5);
}

TEST(Penalty, DampingTakesEnergyFromEveryMotion) {
  Random random(11);
  std::uniform_real_distribution<double> u(-0.1, 0.1);
  for (int i = 0; i < 50; ++i) {
    // One point, so that power is force times its own velocity.
    const Vector3d from(u(random), u(random), u(random)), to(u(random), u(random), u(random));
    const ContactCase moving{DistanceField(Sphere{0.3}), onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                             oneChord(0.2, translation(from), translation(to))};
    const Vector3d velocity = (to - from) / 0.2;
    const Vector3d force = moving.run(onlyDamping(40.0)).on_shell_body.force / 0.2;
    EXPECT_LT(force.dot(velocity), 0.0);
    EXPECT_LT((force + 40.0 * velocity).norm(), 1e-9);
  }
}

TEST(Penalty, DampingSeesRelativeMotionOnly) {
  // Both bodies move together, so that there is no relative velocity.
  const Isometry3d X_FP = translation({0, 0, -0.001});
  const ContactCase riding{DistanceField(ground()),
                           bottomFace(0.05, 4),
                           oneChord(0.1, X_FP, X_FP),
                           {Isometry3d::Identity(), pose({5, 0, 0}, 1.0, Vector3d::UnitX())}};
  EXPECT_LT(riding.run(onlyDamping(1e6)).on_shell_body.force.norm(), 1e-6);
}

TEST(Penalty, OverlappingPartsOfABodyCountOnce) {
  // Two overlapping boxes of one body and a face that is pressed into both: the result is that of their union, a box.
  const double top = 0.1;
  const DistanceField left(Box::fromSize({0.6, 0.6, 2.0 * top})), right(Box::fromSize({0.6, 0.6, 2.0 * top})),
      both(Box::fromSize({0.8, 0.6, 2.0 * top}));
  const Isometry3d X_BL = translation({-0.1, 0, 0}), X_BR = translation({0.1, 0, 0});
  const PointShell face = bottomFace(0.05, 20);
  // Deeper than the distance to the boxes' end faces, so that ownership decides.
  const Isometry3d X_BP = translation({0, 0, top - 0.03});
  const ContactCase whole{both, face, oneChord(1.0, X_BP, X_BP)};
  const ContactCase in_left{left,
                            face,
                            oneChord(1.0, X_BL.inverse() * X_BP, X_BL.inverse() * X_BP),
                            {X_BL, X_BL},
                            {{&right, X_BR.inverse() * X_BL, false}}};
  const ContactCase in_right{right,
                             face,
                             oneChord(1.0, X_BR.inverse() * X_BP, X_BR.inverse() * X_BP),
                             {X_BR, X_BR},
                             {{&left, X_BL.inverse() * X_BR, true}}};
  Wrench sum = in_left.run(perArea()).on_shell_body;
  sum += in_right.run(perArea()).on_shell_body;
  const Wrench expected = whole.run(perArea()).on_shell_body;
  EXPECT_GT(expected.force.z(), 100.0);
  EXPECT_LT((sum.force - expected.force).norm(), 1e-6 * expected.force.norm());
  EXPECT_LT((sum.torque - expected.torque).norm(), 1e-6 * expected.force.norm());
  int theirs = 0;
  for (const HitDepth& depth : in_right.run(perArea()).depths) theirs += depth.siblings;
  EXPECT_EQ(theirs, 400);
}

TEST(Penalty, OwnershipChangesInTheMiddleOfAPath) {
  // A point slides from one box's half of the overlap to the other's, deep inside: the deeper box owns the contact.
  const DistanceField left(Box::fromSize({0.6, 0.6, 0.6})), right(Box::fromSize({0.6, 0.6, 0.6}));
  const Isometry3d X_LR = translation({0.2, 0, 0}), X_RL = X_LR.inverse();
  const Isometry3d from = translation({-0.05, 0, 0}), to = translation({0.25, 0, 0});
  const PointShell point = onePoint(Vector3d::Zero(), -Vector3d::UnitX());
  ContactOptions options = perArea();
  options.normal = NormalSource::kShell;
  const ContactCase in_left{
      left, point, oneChord(1.0, from, to), {Isometry3d::Identity(), Isometry3d::Identity()}, {{&right, X_RL, false}}};
  const ContactCase in_right{right, point, oneChord(1.0, X_RL * from, X_RL * to), {X_LR, X_LR}, {{&left, X_LR, true}}};
  // Depth in the union's deeper part along x from -0.05 to 0.25: 0.3 − |x| and 0.3 − |x − 0.2| meet at x = 0.1.
  double expected = 0.0;
  for (int i = 0; i < 30000; ++i) {
    const double x = -0.05 + 0.3 * (i + 0.5) / 30000;
    expected += kStiffness * std::max(0.3 - std::abs(x), 0.3 - std::abs(x - 0.2)) / 30000;
  }
  const double found = in_left.run(options).on_shell_body.force.x() + in_right.run(options).on_shell_body.force.x();
  EXPECT_NEAR(found, expected, 1e-6 * expected);
}

TEST(Penalty, TouchWithoutLengthCarriesNothing) {
  const ContactCase touching{DistanceField(ground()), onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                             oneChord(1.0, translation({0, 0, 0.1}), translation({0, 0, 0.0}))};
  const ContactImpulse result = touching.run(perArea());
  EXPECT_NEAR(result.on_shell_body.force.norm(), 0.0, 1e-9);
  ASSERT_EQ(result.depths.size(), 1u);
  EXPECT_NEAR(result.depths[0].depth, 0.0, 1e-12);
}

TEST(Penalty, RefusesBadOptions) {
  ContactOptions options;
  options.stiffness = -1.0;
  EXPECT_THROW(validate(options), std::invalid_argument);
  options = {};
  options.damping = std::nan("");
  EXPECT_THROW(validate(options), std::invalid_argument);
  options = {};
  options.midpoint_intervals = 0;
  EXPECT_THROW(validate(options), std::invalid_argument);
  ContactCase poses{DistanceField(ground()), bottomFace(0.1, 1),
                    oneChord(1.0, Isometry3d::Identity(), Isometry3d::Identity())};
  poses.X_CF.pop_back();
  EXPECT_THROW(poses.run(perArea()), std::invalid_argument);
}

}  // namespace sdf_ccd::penalty_test
