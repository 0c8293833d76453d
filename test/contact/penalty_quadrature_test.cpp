#include <functional>
#include <random>

#include <gtest/gtest.h>

#include "contact/curved_field.h"
#include "oracle/contact_case.h"
#include "oracle/random.h"

namespace sdf_ccd::penalty_quadrature_test {

using namespace test;

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

/// Inside a box the direction to the nearest face changes at once: where it does, that of a sampled field turns by up
/// to a right angle within one cell.
TEST(Penalty, ExactRuleFollowsNormalsThatTurnWithinACell) {
  const Primitive box = Box::fromSize({0.7, 0.66, 0.62});
  const auto inBox =
      sampledFunction([&](const Vector3d& p) { return signedDistance(box, p); }, Vector3i::Ones(), 0.1, 1.0);
  ContactOptions exact = perArea(), twenty = perArea(), dense = perArea();
  twenty.quadrature = dense.quadrature = Quadrature::kMidpoint;
  dense.midpoint_intervals = 10000;
  Random random(9);
  for (const DistanceField& field : {curvedField(), inBox}) {
    double worst = 0.0, sum = 0.0, midpoint_sum = 0.0, size = 0.0;
    for (int i = 0; i < 200; ++i) {
      const Vector3d from = pointInCube(random, 0.3);
      const Vector3d to = from + std::pow(10.0, uniform(random, -3.0, -0.5)) * direction(random);
      const ContactCase moving{field, onePoint(Vector3d::Zero(), -Vector3d::UnitZ()),
                               oneChord(0.1, translation(from), translation(to))};
      const Vector3d reference = moving.run(dense).on_shell_body.force;
      const double error = (moving.run(exact).on_shell_body.force - reference).norm();
      worst = std::max(worst, error / (reference.norm() + 1e-3 * kStiffness));
      sum += error;
      midpoint_sum += (moving.run(twenty).on_shell_body.force - reference).norm();
      size += reference.norm();
    }
    EXPECT_LT(worst, 1e-3);
    EXPECT_LT(sum, 1e-4 * size);
    EXPECT_GT(midpoint_sum, 10.0 * sum);
  }
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
  const std::vector<Round> bodies = {{DistanceField(Cylinder::fromRadiusAndLength(0.5, 0.6)),
                                      [&](const Vector3d& p) { return inCylinder(p, 0.5, 0.3); }},
                                     {DistanceField(Cylinder::fromRadiusAndLength(0.5, 0.1)),
                                      [&](const Vector3d& p) { return inCylinder(p, 0.5, 0.05); }},
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

}  // namespace sdf_ccd::penalty_quadrature_test
