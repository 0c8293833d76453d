#include "contact/penalty.h"

#include <functional>

#include <gtest/gtest.h>

#include "oracle/contact_case.h"
#include "oracle/random.h"
#include "oracle/sampled_function.h"
#include "sdf_ccd/field/build_field.h"

namespace sdf_ccd {
namespace {

using namespace test;

constexpr double kStiffness = 1e7;

ContactOptions perArea() {
  ContactOptions options;
  options.stiffness = kStiffness;
  return options;
}

ContactOptions onlyDamping(double damping) {
  ContactOptions options;
  options.stiffness = 0.0;
  options.damping = damping;
  return options;
}

/// A brick of smooth but curved values, so that every cell is a different trilinear function.
DistanceField curvedField() {
  const auto value = [](const Vector3d& p) {
    const double wave = 0.05 * std::sin(9.0 * p.x()) * std::cos(7.0 * p.y()) + 0.02 * std::sin(11.0 * p.z());
    return 0.75 * (0.9 * p.z() - 0.1 + wave);
  };
  return test::sampledFunction(value, Vector3i::Ones(), 0.1, 0.2);
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
  const DistanceField plate(Box{{0.2, 0.2, thickness / 2.0}});
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

TEST(Penalty, DepthSaysWhatItMayBeWrongBy) {
  // A cube of side 0.4 m in cells of 0.00625 m; deep inside, the field stores one value per brick corner.
  FieldOptions sampling;
  sampling.cells = 64;
  const DistanceField cube = buildField(boxMesh(Vector3d::Constant(0.2)), sampling);
  for (const double depth : {0.01, 0.02, 0.1, 0.17}) {
    const Isometry3d X_FP = translation({0.2 - depth, 0.004, -0.01});
    const ContactCase inside{cube, onePoint(Vector3d::Zero(), Vector3d::UnitX()), oneChord(1.0, X_FP, X_FP)};
    const HitDepth found = inside.run(perArea(), {false, true}).depths.at(0);
    EXPECT_LE(std::abs(found.depth - depth), found.error) << depth;
    EXPECT_EQ(found.error > cube.errorBound(), depth > 0.05) << depth;
  }
}

TEST(Penalty, DepthIsFoundBetweenTheNodes) {
  // A point passes a sphere's centre at the distance b: the largest depth is R − b. It starts inside, off the middle.
  const double R = 0.1, b = 0.08;
  const ContactCase passing{DistanceField(Sphere{R}), onePoint({0, b, 0}, -Vector3d::UnitY()),
                            oneChord(1.0, translation({-0.0317, 0, 0}), translation({0.37, 0, 0}))};
  const HitDepth deepest = passing.run(perArea(), {false, true}).depths.at(0);
  EXPECT_NEAR(deepest.depth, R - b, 1e-9);
  EXPECT_LE(deepest.depth, R - b + 1e-15);
  EXPECT_NEAR(deepest.time, 0.0317 / 0.4017, 1e-4);
  EXPECT_LT((deepest.normal_C - Vector3d::UnitY()).norm(), 1e-3);
  EXPECT_LT((deepest.p_C - Vector3d(0, b, 0)).norm(), 1e-4);
}

/// Along a straight path through a convex solid the depth is concave: a ternary search finds its maximum.
TEST(Penalty, DepthInRoundBodiesIsExact) {
  const auto inCylinder = [](const Vector3d& p) { return std::min(0.5 - p.head<2>().norm(), 0.3 - std::abs(p.z())); };
  const auto inBall = [](const Vector3d& p) { return 0.5 - p.norm(); };
  const std::vector<std::pair<DistanceField, std::function<double(const Vector3d&)>>> bodies = {
      {DistanceField(Cylinder{0.5, 0.3}), inCylinder}, {DistanceField(Sphere{0.5}), inBall}};
  Random random(12);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (const auto& [field, depthAt] : bodies) {
    int found = 0;
    for (int i = 0; i < 2000; ++i) {
      // The point nearest to the center or axis is often close to one end of the path.
      const Vector3d middle = 0.5 * Vector3d(u(random), u(random), u(random)),
                     way = std::pow(10.0, u(random) - 0.7) * Vector3d(u(random), u(random), i % 3 ? u(random) : 0.0);
      const double at = 0.5 + 0.5 * u(random) * u(random) * u(random);
      const Vector3d from = middle - at * way;
      const ContactCase moving{field, onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                               oneChord(1.0, translation(from), translation(from + way))};
      const std::vector<HitDepth> depths = moving.run(perArea(), {i % 2 == 0, true}).depths;
      double low = 0.0, high = 1.0;
      for (int step = 0; step < 200; ++step) {
        const double a = (2.0 * low + high) / 3.0, b = (low + 2.0 * high) / 3.0;
        (depthAt(from + a * way) < depthAt(from + b * way) ? low : high) =
            depthAt(from + a * way) < depthAt(from + b * way) ? a : b;
      }
      const double deepest = depthAt(from + low * way);
      if (!(deepest > 1e-9)) continue;
      ASSERT_EQ(depths.size(), 1u) << i;
      ASSERT_NEAR(depths[0].depth, deepest, 1e-8) << i;
      ++found;
    }
    EXPECT_GT(found, 1000);
  }
}

TEST(Penalty, WithoutImpulseOnlyDepthsAreFound) {
  const Isometry3d X_FP = translation({0, 0, -0.002});
  const ContactCase pressed{DistanceField(ground()), bottomFace(0.05, 4), oneChord(1.0, X_FP, X_FP)};
  const ContactImpulse with = pressed.run(perArea()), without = pressed.run(perArea(), {false, true});
  EXPECT_EQ(without.on_shell_body.force, Vector3d::Zero());
  EXPECT_EQ(without.on_shell_body.torque, Vector3d::Zero());
  ASSERT_EQ(with.depths.size(), without.depths.size());
  for (std::size_t i = 0; i < with.depths.size(); ++i) EXPECT_EQ(with.depths[i].depth, without.depths[i].depth);
}

TEST(Penalty, WithoutErrorsAllElseIsTheSame) {
  Random random(3);
  for (const DistanceField& field : {curvedField(), DistanceField(Primitive(Box{{0.3, 0.2, 0.1}}))}) {
    const Isometry3d X_FP = pose(random, 3.0, 0.05), X_end = translation({0.01, -0.02, 0.01}) * X_FP;
    const ContactCase pressed{field, spiralSphere(0.15, 60), oneChord(1.0, X_FP, X_end)};
    for (const bool impulse : {false, true}) {
      const ContactImpulse with = pressed.run(perArea(), {impulse, true}),
                           without = pressed.run(perArea(), {impulse, false});
      EXPECT_EQ(with.on_shell_body.force, without.on_shell_body.force);
      EXPECT_EQ(with.on_shell_body.torque, without.on_shell_body.torque);
      ASSERT_EQ(with.depths.size(), without.depths.size());
      ASSERT_GT(with.depths.size(), 5u);
      for (std::size_t i = 0; i < with.depths.size(); ++i) {
        const HitDepth &a = with.depths[i], &b = without.depths[i];
        EXPECT_EQ(a.depth, b.depth);
        EXPECT_EQ(a.p_C, b.p_C);
        EXPECT_EQ(a.normal_C, b.normal_C);
        EXPECT_EQ(a.error, field.sample(b.p_F).error);
      }
    }
  }
}

TEST(Penalty, ExactRuleIntegratesTheInterpolatedField) {
  Random random(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  const DistanceField field = curvedField();
  ContactOptions exact = perArea(), twenty = perArea(), dense = perArea();
  exact.normal = twenty.normal = dense.normal = NormalSource::kShell;
  twenty.quadrature = dense.quadrature = Quadrature::kMidpoint;
  dense.midpoint_intervals = 10000;
  double exact_error = 0.0, midpoint_error = 0.0, size = 0.0;
  for (int i = 0; i < 100; ++i) {
    const Vector3d from(0.35 * u(random), 0.35 * u(random), 0.35), to(0.35 * u(random), 0.35 * u(random), -0.3);
    const Vector3d normal(u(random), u(random), u(random) - 2.0);
    const ContactCase crossing{field, onePoint(Vector3d::Zero(), normal.normalized()),
                               oneChord(0.1, translation(from), translation(to))};
    const Wrench reference = crossing.run(dense).on_shell_body;
    const Wrench a = crossing.run(exact).on_shell_body, b = crossing.run(twenty).on_shell_body;
    size += reference.force.norm();
    exact_error += (a.force - reference.force).norm() + (a.torque - reference.torque).norm();
    midpoint_error += (b.force - reference.force).norm() + (b.torque - reference.torque).norm();
  }
  EXPECT_LT(exact_error, 1e-7 * size);  // mostly the error of the reference
  EXPECT_GT(midpoint_error, 1e-4 * size);
  EXPECT_LT(midpoint_error, 1e-2 * size);
}

TEST(Penalty, LinearNormalsAreCloseToTheFieldsOwn) {
  ContactOptions exact = perArea(), dense = perArea();
  dense.quadrature = Quadrature::kMidpoint;
  dense.midpoint_intervals = 10000;
  const ContactCase crossing{curvedField(), onePoint({0.05, -0.12, 0}, -Vector3d::UnitZ()),
                             oneChord(0.1, translation({0, 0, 0.35}), translation({0.1, 0.2, -0.25}))};
  const Vector3d reference = crossing.run(dense).on_shell_body.force, found = crossing.run(exact).on_shell_body.force;
  EXPECT_LT((found - reference).norm(), 1e-3 * reference.norm());
}

/// Deep in a cylinder or ball the nearest face changes at once, or the direction to it within a short part of the path.
TEST(Penalty, ExactRuleIsRightDeepInRoundBodies) {
  struct Outward {
    double depth;
    Vector3d normal;
  };
  const auto inCylinder = [](const Vector3d& p, double radius, double half) {
    const Vector3d aside(p.x(), p.y(), 0.0);
    const double to_side = radius - aside.norm(), to_cap = half - std::abs(p.z());
    if (to_side < to_cap) return Outward{to_side, aside.normalized()};
    return Outward{to_cap, std::copysign(1.0, p.z()) * Vector3d::UnitZ()};
  };
  const auto inBall = [](const Vector3d& p, double radius) { return Outward{radius - p.norm(), p.normalized()}; };
  struct Round {
    DistanceField field;
    std::function<Outward(const Vector3d&)> at;
  };
  const std::vector<Round> bodies = {
      {DistanceField(Cylinder{0.5, 0.3}), [&](const Vector3d& p) { return inCylinder(p, 0.5, 0.3); }},
      {DistanceField(Cylinder{0.5, 0.05}), [&](const Vector3d& p) { return inCylinder(p, 0.5, 0.05); }},
      {DistanceField(Sphere{0.5}), [&](const Vector3d& p) { return inBall(p, 0.5); }}};
  Random random(8);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (const Round& body : bodies) {
    double sum = 0.0, worst = 0.0, shallower = 0.0;
    constexpr int kPaths = 200, kNodes = 20000;
    for (int i = 0; i < kPaths; ++i) {
      // Every other path passes close to the center.
      const double near = i % 2 ? 0.02 : 0.8;
      const Vector3d from = 0.8 * Vector3d(u(random), u(random), u(random)),
                     through = near * Vector3d(u(random), u(random), u(random)) - (i % 2 ? 1.0 : 0.0) * from;
      // Most paths are shorter than the distance from the center, so that the direction hardly turns on them.
      const Vector3d to = from + std::pow(10.0, -0.5 * (i / 2 % 5)) * (through - from);
      Vector3d reference = Vector3d::Zero();
      double size = 0.0, deepest = 0.0;
      for (int k = 0; k < kNodes; ++k) {
        const Outward at = body.at(from + (k + 0.5) / kNodes * (to - from));
        if (at.depth <= 0.0) continue;
        reference += kStiffness * at.depth / kNodes * at.normal;
        size += kStiffness * at.depth / kNodes;
        deepest = std::max(deepest, at.depth);
      }
      if (size == 0.0) continue;
      const ContactCase moving{body.field, onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                               oneChord(1.0, translation(from), translation(to))};
      const ContactImpulse found = moving.run(perArea());
      const double error = (found.on_shell_body.force - reference).norm() / size;
      sum += error;
      worst = std::max(worst, error);
      double depth = 0.0;
      for (const HitDepth& hit : found.depths) depth = std::max(depth, hit.depth);
      shallower = std::max(shallower, deepest - depth);
    }
    EXPECT_LT(sum / kPaths, 2e-4);
    EXPECT_LT(worst, 3e-3);
    EXPECT_LT(shallower, 1e-4);
  }
}

TEST(Penalty, FrameOfIntegrationOnlyTurnsTheWrench) {
  Random random(3);
  ContactOptions options = perArea();
  options.damping = 1e4;
  for (int i = 0; i < 20; ++i) {
    const Isometry3d turn = pose(random, 3.0, 1.0), X_CF0 = pose(random, 3.0, 1.0), X_CF1 = pose(random, 3.0, 1.0);
    ContactCase moving{DistanceField(Box{{0.3, 0.2, 0.1}}),
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
  ContactCase moving{DistanceField(Box{{0.3, 0.2, 0.1}}), spiralSphere(0.2, 300),
                     oneChord(0.3, translation({0.4, 0, 0.1}), translation({0.2, 0.1, 0.1}))};
  const Wrench before = moving.run(perArea()).on_shell_body;
  const Isometry3d X_PQ = pose(random, 3.0, 1.0);
  for (Vector3d& p : moving.shell.points) p = X_PQ.inverse() * p;
  for (Vector3f& n : moving.shell.normals) n = X_PQ.linear().transpose().cast<float>() * n;
  moving.path.chords[0].X_FP_start = moving.path.chords[0].X_FP_start * X_PQ;
  moving.path.chords[0].X_FP_end = moving.path.chords[0].X_FP_end * X_PQ;
  const Wrench after = moving.run(perArea()).on_shell_body;
  EXPECT_LT((after.force - before.force).norm(), 1e-9 * before.force.norm());
  EXPECT_LT((after.torque - before.torque).norm(), 1e-9 * before.force.norm());
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
  const DistanceField left(Box{{0.3, 0.3, top}}), right(Box{{0.3, 0.3, top}}), both(Box{{0.4, 0.3, top}});
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
  const DistanceField left(Box{{0.3, 0.3, 0.3}}), right(Box{{0.3, 0.3, 0.3}});
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

}  // namespace
}  // namespace sdf_ccd
