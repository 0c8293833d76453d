#include <random>

#include <gtest/gtest.h>

#include "contact/curved_field.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/field_access.h"
#include "oracle/contact_case.h"
#include "oracle/random.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::penalty_depth_test {

using namespace test;

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
  EXPECT_NEAR(deepest.depth, R - b, passing.shell.position_error + 1e-9);
  EXPECT_LE(deepest.depth, R - b + passing.shell.position_error + 1e-15);
  EXPECT_NEAR(deepest.time, 0.0317 / 0.4017, 1e-4);
  EXPECT_LT((deepest.normal_C - Vector3d::UnitY()).norm(), 1e-3);
  EXPECT_LT((deepest.p_C - Vector3d(0, b, 0)).norm(), 1e-4);
}

/// Along a straight path through a convex solid the depth is concave: a ternary search finds its maximum.
TEST(Penalty, DepthInRoundBodiesIsExact) {
  const auto inCylinder = [](const Vector3d& p) { return std::min(0.5 - p.head<2>().norm(), 0.3 - std::abs(p.z())); };
  const auto inBall = [](const Vector3d& p) { return 0.5 - p.norm(); };
  const std::vector<std::pair<DistanceField, std::function<double(const Vector3d&)>>> bodies = {
      {DistanceField(Cylinder::fromRadiusAndLength(0.5, 0.6)), inCylinder}, {DistanceField(Sphere{0.5}), inBall}};
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
  for (const DistanceField& field : {curvedField(), DistanceField(Primitive(Box::fromSize({0.6, 0.4, 0.2})))}) {
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
        EXPECT_EQ(a.error, depthError(field, b.p_F, b.depth));
      }
    }
  }
}

/// An adaptive field jumps where cells of two sizes meet: a depth found in one of them has an error that the other one
/// does not tell. Points move to and from places on the faces of cells.
TEST(Penalty, DepthsOnTheFacesOfCellsHaveErrorsThatHold) {
  const Vector3d half(4.0 / 64, 2.0 / 64, 1.0 / 64);
  FieldOptions coarse;
  coarse.max_error = 0.001;
  coarse.cells.reset();
  const DistanceField field = buildField(boxMesh(half), coarse);
  const AdaptiveShape& shape = FieldAccess::adaptive(field)->shape();
  Random random(5);
  int jumps = 0;
  for (int i = 0; i < 20000; ++i) {
    const int stride = 1 << (i % 8);
    Vector3d face = uniformIn(random, {-half, half});
    face = shape.origin +
           shape.unit() * stride * ((face - shape.origin) / (shape.unit() * stride)).array().round().matrix();
    if (signedDistance(Box::fromSize(2.0 * half), face) > -1e-4) continue;
    const Vector3d beside = face + 0.003 * direction(random);
    const bool ends = random() % 2;
    const ContactCase moving{field, onePoint(Vector3d::Zero(), Vector3d::UnitZ()),
                             oneChord(1.0, translation(ends ? beside : face), translation(ends ? face : beside))};
    for (const HitDepth& found : moving.run(perArea()).depths) {
      const double truth = -signedDistance(Box::fromSize(2.0 * half), found.p_F);
      EXPECT_LE(std::abs(found.depth - truth), found.error + 1e-12) << face.transpose();
      jumps += std::abs(found.depth - truth) > field.sample(found.p_F).error;
    }
  }
  EXPECT_GT(jumps, 0) << "nothing tests the jumps";
}

}  // namespace sdf_ccd::penalty_depth_test
