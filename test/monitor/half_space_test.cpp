// Verdicts about bodies and a half-space against the lowest points of boxes, balls and cylinders.
#include <gtest/gtest.h>

#include "monitor/half_space_case.h"
#include "oracle/drawn_meshes.h"
#include "oracle/open_shapes.h"
#include "oracle/random.h"
#include "oracle/shapes.h"
#include "shell/point_shell.h"

namespace sdf_ccd::half_space_test {

using namespace test;

const Vector3d kHalf(0.1, 0.05, 0.02);
constexpr double kRadius = 0.04, kHalfLength = 0.07;

/// Shapes, and how far each reaches against a direction of its frame.
struct Case {
  const char* name;
  Shape shape;
  double (*depthAlong)(const Vector3d& down);
};

double boxDepth(const Vector3d& down) {
  return down.cwiseAbs().dot(kHalf);
}

const Case kCases[] = {
    {"box", Primitive(Box::fromSize(2.0 * kHalf)), boxDepth},
    {"mesh", meshShape(boxMesh(kHalf)), boxDepth},
    {"open mesh", meshShape(without(boxMesh(kHalf), [](const Vector3d& p) { return p.z() > 0.9 * kHalf.z(); })),
     boxDepth},
    {"ball", Primitive(Sphere{kRadius}), [](const Vector3d&) { return kRadius; }},
    {"cylinder", Primitive(Cylinder::fromRadiusAndLength(kRadius, 2.0 * kHalfLength)),
     [](const Vector3d& down) { return kRadius * std::hypot(down.x(), down.y()) + kHalfLength * std::abs(down.z()); }},
};

Isometry3d anyPose(Random& random, double distance) {
  return test::pose(random, kPi, distance);
}

/// The half-space is tilted, far out, in a frame of its own, and both bodies move, together and against each other.
TEST(HalfSpacePair, TellsATenthOfAMillimetre) {
  Random random(5);
  int clear = 0, contact = 0;
  for (const Case& each : kCases) {
    for (int trial = 0; trial < 200; ++trial) {
      const Isometry3d X_BG = anyPose(random, 2.0), X_WB = anyPose(random, 3.0);
      Fall fall(each.shape, X_BG, trial % 2 == 0);
      const Isometry3d R = test::pose(random, kPi, 0.0);
      const Vector3d down = R.linear().transpose() * -Vector3d::UnitZ();
      const double gap = (trial % 4 < 2 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, -4.0, -1.5));
      // A sheet's lowest point may lie in its opening.
      const double low = each.depthAlong(down);
      if (each.name == std::string("open mesh") && down.z() > -0.5) continue;
      const Vector3d end = {uniform(random, -20.0, 20.0), uniform(random, -20.0, 20.0), low + gap};
      const Vector3d start = end + Vector3d(uniform(random, -0.3, 0.3), uniform(random, -0.3, 0.3), 0.05);
      const Isometry3d X_BG_moved = trial % 3 == 0 ? Isometry3d(translation({0.1, 0.2, 0.3})) : Isometry3d::Identity();
      const auto placed = [&](const Vector3d& p) { return X_WB * X_BG * translation(p) * R; };
      const PairResult result = fall.run({X_WB, X_BG_moved * X_WB}, {placed(start), X_BG_moved * placed(end)});
      ASSERT_EQ(result.verdict, gap > 0.0 ? Verdict::kClear : Verdict::kContact)
          << each.name << " " << trial << " " << gap;
      EXPECT_LT(result.error.total(), 1e-5);
      if (gap > 0.0) {
        EXPECT_LE(result.clearance, gap + 1e-12);
      } else {
        EXPECT_GE(result.intervals.front().enter, 0.0);
        EXPECT_LE(result.deepest.depth - result.deepest.depth_error, -gap + 1e-9);
        // Between points a curved surface may be deeper.
        const double known = result.deepest.depth + result.deepest.depth_error + result.contact_error.gap;
        EXPECT_GE(known, std::min(-gap, 2.0 * low) - 1e-9) << each.name;
      }
      ++(gap > 0.0 ? clear : contact);
    }
  }
  EXPECT_GT(clear, 400);
  EXPECT_GT(contact, 400);
}

/// Shapes of a larger size, and how far each reaches against a direction of its frame.
const Case kLargeCases[] = {
    {"box", Primitive(Box::fromSize({0.6, 0.4, 0.2})),
     [](const Vector3d& down) { return down.cwiseAbs().dot(Vector3d(0.3, 0.2, 0.1)); }},
    {"flat cylinder", Primitive(Cylinder::fromRadiusAndLength(0.3, 0.1)),
     [](const Vector3d& down) { return 0.3 * std::hypot(down.x(), down.y()) + 0.05 * std::abs(down.z()); }},
    {"long cylinder", Primitive(Cylinder::fromRadiusAndLength(0.02, 1.0)),
     [](const Vector3d& down) { return 0.02 * std::hypot(down.x(), down.y()) + 0.5 * std::abs(down.z()); }},
};

/// A turn dips a body below the ground for a moment, or nearly. The truth is sampled densely.
TEST(HalfSpacePair, SeesWhatATurnDips) {
  Random random(6);
  int contacts = 0, clear = 0;
  for (const Case& each : kLargeCases) {
    Fall fall(each.shape, Isometry3d::Identity());
    for (int trial = 0; trial < 400; ++trial) {
      const Vector3d axis = direction(random);
      const double angle = uniform(random, 0.1, 3.0);
      const Isometry3d R = test::pose(random, kPi, 0.0);
      double deepest = -1e9;
      for (int i = 0; i <= 2000; ++i) {
        const Matrix3d turned = Eigen::AngleAxisd(angle * i / 2000.0, axis).toRotationMatrix() * R.linear();
        deepest = std::max(deepest, each.depthAlong(turned.transpose() * -Vector3d::UnitZ()));
      }
      const double gap = (trial % 2 == 0 ? 1.0 : -1.0) * std::pow(10.0, uniform(random, std::log10(1.2e-4), -2.0));
      const Isometry3d X = translation({0.3, 0.2, deepest + gap});
      Isometry3d turn = Isometry3d::Identity();
      turn.linear() = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
      const Verdict verdict = fall.run(still(Isometry3d::Identity()), {X * R, X * turn * R}).verdict;
      EXPECT_EQ(verdict, gap > 0.0 ? Verdict::kClear : Verdict::kContact) << each.name << " " << trial << " " << gap;
      ++(gap > 0.0 ? clear : contacts);
    }
  }
  EXPECT_GT(contacts, 500);
  EXPECT_GT(clear, 500);
}

/// UNCERTAIN means: nearly touching, in both directions. What is nearest then is searched for by bisection of the
/// height at which the verdict changes.
TEST(HalfSpacePair, UncertainIsANarrowBand) {
  Random random(9);
  for (const Case& each : kLargeCases) {
    Fall fall(each.shape, Isometry3d::Identity());
    for (int trial = 0; trial < 60; ++trial) {
      const Isometry3d start = test::pose(random, kPi, 0.0), turn = test::pose(random, 3.0, 0.3);
      double error = 0.0;
      const auto verdictAt = [&](double height) {
        const Isometry3d X = translation({0, 0, height}) * start;
        fall.monitor->reset();
        const PairResult result =
            fall.run(still(Isometry3d::Identity()), {X, X * turn}, trial % 2 == 0 ? verdictOnly() : CycleRequest());
        if (result.verdict == Verdict::kUncertain) error = std::max(error, result.error.total());
        return result.verdict;
      };
      const auto changeFrom = [&](Verdict verdict, double low, double high) {
        while (high - low > 1e-6) (verdictAt(0.5 * (low + high)) == verdict ? low : high) = 0.5 * (low + high);
        return low;
      };
      const double contact_below = changeFrom(Verdict::kContact, -2.0, 2.0);
      double clear_above = contact_below;
      while (verdictAt(clear_above) != Verdict::kClear) clear_above += 1e-6;
      EXPECT_LE(clear_above - contact_below, 1e-4) << each.name;
      EXPECT_LE(error, 1.03e-4) << each.name;  // that of the triangles included
    }
  }
}

/// A ball of many triangles flies along the ground for a hundred metres, spinning about its way, on which the height of
/// its center is then monotonic in each step. It is lowest somewhere.
TEST(HalfSpacePair, DecidesLongMotionsOfDenseMeshes) {
  Random random(8);
  const double radius = 0.3, sag = 1e-5;  // a triangle's middle is that much nearer to the center than its corners
  Fall fall(meshShape(icosphere(radius, 6)), Isometry3d::Identity());
  for (int trial = 0; trial < 20; ++trial) {
    const double gap = (trial % 2 == 0 ? 1.0 : -1.0) * uniform(random, 1.2e-4, 1e-3), turn = uniform(random, 0.3, 2.5);
    const int lowest = static_cast<int>(uniform(random, 0.0, 100.0));
    std::vector<Isometry3d> X_WP;
    for (int k = 0; k <= 100; ++k) {
      const double height = radius + (gap > 0.0 ? gap + sag : gap) + 2e-4 * std::abs(k - lowest);
      X_WP.push_back(translation({k * 1.0, 0.0, height}) * pose({0, 0, 0}, k * turn, {1, 0, 0}));
    }
    fall.monitor->reset();
    EXPECT_EQ(fall.run(still(Isometry3d::Identity(), X_WP.size()), X_WP).verdict,
              gap > 0.0 ? Verdict::kClear : Verdict::kContact)
        << gap << " " << turn;
  }
}

/// Whatever is below the surface is in contact, all the time, with the half-space's normal.
TEST(HalfSpacePair, WhatIsWhollyBelowIsAContact) {
  for (const bool ground_first : {true, false})
    for (const Case& each : kCases)
      for (const bool wants_contacts : {true, false})
        for (const double height : {-0.2, -3.0, -0.03}) {
          Fall fall(each.shape, Isometry3d::Identity(), ground_first);
          CycleRequest request;
          request.contacts = request.wrenches = wants_contacts;
          const auto at = still(translation({1, 2, height}));
          const PairResult result = fall.run(still(Isometry3d::Identity()), at, request);
          ASSERT_EQ(result.verdict, Verdict::kContact) << each.name << " " << height;
          EXPECT_NEAR(result.deepest.normal_W.z(), ground_first ? 1.0 : -1.0, 1e-9) << each.name << " " << height;
          if (height > -0.1 && each.name != std::string("mesh") && each.name != std::string("box")) continue;
          ASSERT_EQ(result.intervals.size(), 1u);
          EXPECT_EQ(result.intervals.front().enter, 0.0);
          EXPECT_EQ(result.intervals.front().exit, 0.1);
        }
}

/// In one cycle over many times its size, there and back.
TEST(HalfSpacePair, SeesWhatIsFarAway) {
  Fall fall(Primitive(Sphere{0.05}), Isometry3d::Identity());
  const Isometry3d tilted = pose({0, 0, 0}, 1e-3, {0, 1, 0});  // falls by 1 m over a kilometre
  const auto over = [&](double height) {
    return fall.run(still(tilted, 3),
                    {translation({0, 0, height}), translation({1000, 0, height}), translation({0, 5, height})});
  };
  EXPECT_EQ(over(0.051).verdict, Verdict::kClear);
  EXPECT_EQ(
      fall.run(still(tilted, 3), {translation({0, 0, 0.06}), translation({-1000, 0, 0.06}), translation({0, 5, 2})})
          .verdict,
      Verdict::kContact);
  EXPECT_EQ(fall.run(still(tilted, 3), {translation({0, 0, 3}), translation({-1000, 0, 1.06}), translation({0, 5, 2})})
                .verdict,
            Verdict::kClear);
}

/// Where it is doubtful what is inside a mesh, it is certain what is above the ground.
TEST(HalfSpacePair, NeedsNoInside) {
  const TriangleMesh doubtful = merged(boxMesh(kHalf), translated(boxMesh(kHalf), {0.05, 0.01, 0.01}));
  Fall fall(meshShape(flipped(doubtful)), Isometry3d::Identity());
  EXPECT_EQ(fall.run(still(Isometry3d::Identity()), still(translation({0, 0, 0.0201}))).verdict, Verdict::kClear);
  EXPECT_EQ(fall.run(still(Isometry3d::Identity()), still(translation({0, 0, 0.0199}))).verdict, Verdict::kContact);
  EXPECT_EQ(fall.run(still(Isometry3d::Identity()), still(translation({0, 0, -1.0}))).verdict, Verdict::kContact);
}

/// The deepest point of the surface, also where no point of the shell is.
TEST(HalfSpacePair, DepthsAreExactIfRefined) {
  Random random(7);
  CycleRequest request;
  for (const Case& each : kCases) {
    if (each.name == std::string("open mesh")) continue;  // has no solid to measure in
    for (int trial = 0; trial < 100; ++trial) {
      Fall fall(each.shape, anyPose(random, 2.0), trial % 2 == 0);
      const Isometry3d X_BG = fall.scene->bodies[trial % 2].parts[0].X_BG, R = test::pose(random, kPi, 0.0);
      const double low = each.depthAlong(R.linear().transpose() * -Vector3d::UnitZ());
      const double depth = std::pow(10.0, uniform(random, -3.5, trial % 3 == 0 ? 0.5 : -1.5));
      const auto above = [&](double height) { return X_BG * translation({3, -2, low + height}) * R; };
      const PairResult result = fall.run(still(Isometry3d::Identity()), {above(0.05), above(-depth)}, request);
      ASSERT_EQ(result.verdict, Verdict::kContact);
      ASSERT_TRUE(result.measured);
      EXPECT_NEAR(result.deepest.depth, depth, 6e-5) << each.name;
      EXPECT_GE(result.deepest.depth + result.deepest.depth_error, depth - 1e-9) << each.name;
      EXPECT_LT(result.deepest.depth_error, 2e-4) << each.name;
      ASSERT_TRUE(result.first_touch);
      EXPECT_NEAR(result.first_touch->enter, 0.1 * 0.05 / (0.05 + depth), 1e-3 * 0.1) << each.name;
      const Vector3d up = (trial % 2 == 0 ? 1.0 : -1.0) * X_BG.linear().col(2);
      EXPECT_LT((result.deepest.normal_W - up).norm(), 1e-9);
    }
  }
}

/// A motion error of a half-space grows with the distance from its body's origin.
TEST(HalfSpacePair, MotionErrorsGrowWithTheDistance) {
  Fall fall(Primitive(Sphere{0.05}), Isometry3d::Identity());
  const auto at = [&](double x, double height) {
    CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()), still(translation({x, 0, 0.05 + height}))});
    motion.motion_error = {0.001, 0.0};
    fall.monitor->reset();
    return fall.monitor->run(motion, {}).verdict;
  };
  EXPECT_EQ(at(0.0, 0.0015), Verdict::kClear);
  EXPECT_EQ(at(0.0, 0.0005), Verdict::kUncertain);
  EXPECT_EQ(at(0.0, -0.0015), Verdict::kContact);
  EXPECT_EQ(at(1000.0, 0.05), Verdict::kUncertain);
  EXPECT_EQ(at(1000.0, 0.15), Verdict::kClear);
}

/// A ground needs no denser shells, and does not enlarge the bound of the scene.
TEST(HalfSpacePair, CostsNothing) {
  const std::vector<BodyDescription> robot = {body("arm", meshShape(icosphere(0.1, 3))),
                                              body("hand", meshShape(boxMesh(kHalf)))};
  std::vector<BodyDescription> on_ground = robot;
  on_ground.push_back(body("ground", ground(), true));
  BodyOptions options;
  const auto alone = build(robot, options), above = build(on_ground, options);
  EXPECT_LT(above->bound.total(), 1e-4);
  EXPECT_EQ(above->bound.total(), alone->bound.total());
  for (int i = 0; i < 2; ++i) EXPECT_EQ(above->bodies[i].shell->size(), alone->bodies[i].shell->size());
}

}  // namespace sdf_ccd::half_space_test
