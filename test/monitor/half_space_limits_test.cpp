// Bodies and a half-space in extreme motions, far out, and with inexact normals and rotations.
#include <chrono>

#include <gtest/gtest.h>

#include "monitor/half_space_case.h"
#include "oracle/random.h"
#include "sdf_ccd/distances.h"

namespace sdf_ccd::half_space_limits_test {

using namespace test;

/// Poses on a carousel, which turns by 3 rad a step. @param heights  of the body's origin.
std::vector<Isometry3d> carousel(double radius, const std::vector<double>& heights) {
  std::vector<Isometry3d> X_WP;
  for (std::size_t k = 0; k < heights.size(); ++k)
    X_WP.push_back(pose({0, 0, 0}, 3.0 * double(k), Vector3d::UnitZ()) * translation({radius, 0, heights[k]}));
  return X_WP;
}

/// Near the surface for long: the search is limited, but the last step is seen, and the error holds.
TEST(HalfSpaceLimits, LongWaysNearTheSurfaceEndSoon) {
  constexpr double kRadius = 0.05;
  Fall fall(Primitive(Sphere{kRadius}), Isometry3d::Identity());
  for (const double radius : {1.0, 10.0, 1e4, 1e6}) {
    std::vector<double> heights(100, kRadius + 2e-5);
    for (const double last : {2e-5, -1.5e-4}) {
      heights.back() = kRadius + last;
      fall.monitor->reset();
      const auto start = std::chrono::steady_clock::now();
      const PairResult result =
          fall.run(still(Isometry3d::Identity(), heights.size()), carousel(radius, heights), verdictOnly());
      EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);
      if (last < 0.0) {
        EXPECT_EQ(result.verdict, Verdict::kContact) << radius;
      } else if (result.verdict == Verdict::kUncertain) {
        EXPECT_GE(result.error.total(), last - 1e-9 * radius);
      } else {
        EXPECT_EQ(result.verdict, Verdict::kClear) << radius;
      }
    }
  }
}

/// Rotations may be off by 1e-6. Then also what lies between two poses is: by that times the way.
TEST(HalfSpaceLimits, InexactRotationsCostAnError) {
  Fall fall(Primitive(Box::fromSize({0.2, 0.2, 0.2})), Isometry3d::Identity());
  for (const double off : {3e-7, -3e-7, 1e-9})
    for (const double way : {10.0, 1e4})
      for (const double gap : {2e-7, -2e-7}) {
        // In truth it turns about the vertical while it moves along the surface.
        const double low = 0.1 * (std::sin(1.0) + std::cos(1.0));
        Isometry3d start = pose({0, 0, low + gap}, 1.0, {0, 1, 0});
        Matrix3d shear = Matrix3d::Identity();
        shear(0, 2) = shear(2, 0) = off;
        start.linear() = shear * start.linear();
        Isometry3d end = start;
        end.linear() = pose({0, 0, 0}, 2.0, {0, 0, 1}).linear() * start.linear();
        end.translation().x() += way;
        const PairResult result = fall.run(still(Isometry3d::Identity()), {start, end}, verdictOnly());
        const Verdict truth = gap > 0.0 ? Verdict::kClear : Verdict::kContact;
        EXPECT_TRUE(result.verdict == truth || std::abs(gap) <= result.error.total()) << off << " " << way;
        fall.monitor->reset();
      }
}

/// A normal that is not quite of length 1 describes the same plane as that which is.
TEST(HalfSpaceLimits, NormalsAreNormalised) {
  for (const double off : {-9e-10, 9e-10}) {
    const double offset = 1e6;
    const HalfSpace plane{(1.0 + off) * Vector3d::UnitZ(), offset};
    const double height = offset / (1.0 + off);
    EXPECT_NEAR(DistanceField(plane).sample({0, 0, height}).value, 0.0, 1e-8);
    for (const double gap : {2e-4, -2e-4}) {
      const auto scene =
          build({body("plane", Primitive(plane)), body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})))}, fine(0.05));
      Monitor monitor(scene, soft());
      const auto above = still(translation({0, 0, height + 0.1 + gap}));
      EXPECT_EQ(monitor.run(cycle(0.1, {still(Isometry3d::Identity()), above}), {}).pairs[0].verdict,
                gap > 0.0 ? Verdict::kClear : Verdict::kContact);
    }
  }
}

/// What is below the surface all the time is in contact all the time, though its lowest point changes.
TEST(HalfSpaceLimits, BelowIsBelowThroughout) {
  Fall ball(Primitive(Sphere{0.1}), Isometry3d::Identity()),
      cylinder(Primitive(Cylinder::fromRadiusAndLength(0.1, 0.1)), Isometry3d::Identity());
  const auto isWhole = [](const PairResult& result) {
    EXPECT_EQ(result.verdict, Verdict::kContact);
    return result.intervals.size() == 1 && result.intervals[0].enter == 0.0 && result.intervals[0].exit >= 0.1;
  };
  for (const double radius : {0.0, 1.0, 10.0}) {
    EXPECT_TRUE(
        isWhole(ball.run(still(Isometry3d::Identity(), 4), carousel(radius, {-1.1, -1.1, -3.0, -1.1}), verdictOnly())))
        << radius;
  }
  // It rolls over its rim, by 1 mm below the plane.
  const auto rolled = [](double angle) {
    const double low = 0.1 * std::abs(std::sin(angle)) + 0.05 * std::abs(std::cos(angle));
    return pose({0, 0, low - 1e-3}, angle, {1, 0, 0});
  };
  for (const bool wants_contacts : {false, true}) {
    cylinder.monitor->reset();
    EXPECT_TRUE(isWhole(cylinder.run(still(Isometry3d::Identity(), 3), {rolled(0.2), rolled(0.7), rolled(1.2)},
                                     wants_contacts ? CycleRequest() : verdictOnly())));
  }
}

/// The triangles of a cylinder deviate from it, to either side.
TEST(HalfSpaceLimits, UncertainHoldsForWhatTrianglesStandFor) {
  constexpr double kRadius = 0.1, kHalf = 0.05;
  Fall fall(Primitive(Cylinder::fromRadiusAndLength(kRadius, 2.0 * kHalf)), Isometry3d::Identity());
  Random random(3);
  int uncertain = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const Isometry3d R = test::pose(random, kPi, 0.0);
    const Vector3d down = R.linear().transpose() * -Vector3d::UnitZ();
    const double low = kRadius * std::hypot(down.x(), down.y()) + kHalf * std::abs(down.z());
    const double height = uniform(random, -5e-6, 5e-6);
    fall.monitor->reset();
    const PairResult result =
        fall.run(still(Isometry3d::Identity()), still(translation({0, 0, low + height}) * R), verdictOnly());
    if (result.verdict != Verdict::kUncertain) continue;
    ++uncertain;
    EXPECT_LE(std::abs(height), result.error.total());
  }
  EXPECT_GT(uncertain, 300);
}

/// The frame of the half-space is so far from its surface that rounding displaces it.
TEST(HalfSpaceLimits, TheErrorHoldsFarFromTheFrame) {
  Isometry3d far = translation({1e12, 0, 0});
  far.linear() = pose({0, 0, 0}, 0.3, {0, 1, 0}).linear();
  BodyDescription plane = body("plane", Primitive(HalfSpace{Vector3d::UnitX(), -1e12 * std::cos(0.3)}));
  plane.geometry[0].X_BG = far;
  const auto scene = build({plane, body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})))}, fine(0.05));
  Monitor monitor(scene, soft());
  const PairResult result =
      monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(Isometry3d::Identity())}), verdictOnly()).pairs[0];
  ASSERT_NE(result.verdict, Verdict::kNotChecked);
  EXPECT_GT(result.error.total(), 1e-5);
}

/// Of a body wholly below a plane that turns, the witnesses and the normal are those of the end.
TEST(HalfSpaceLimits, DistancesAreOfTheEnd) {
  Fall fall(Primitive(Box::fromSize({0.2, 0.1, 0.04})), Isometry3d::Identity());
  for (const double depth : {1.0, 5e-3}) {
    const Isometry3d turn = pose({0.3, 0.1, 0.0}, 1.0, {1, 0, 0});
    const Isometry3d below = translation({0, 0, 0.02 - depth});
    const CycleMotion motion = cycle(0.1, {{Isometry3d::Identity(), turn}, {below, turn * below}});
    CycleRequest request;
    request.skipped_pairs = true;
    PairDistances distances(fall.scene);
    const auto& near = distances.update(motion, fall.monitor->run(motion, request), 0.1, {});
    ASSERT_EQ(near.size(), 1u);
    EXPECT_EQ(near[0].distance, 0.0);
    EXPECT_LT((near[0].normal_W - turn.linear().col(2)).norm(), 1e-9);
    const Vector3d on_box = below.inverse() * turn.inverse() * near[0].p_B_W;
    EXPECT_LT((on_box.cwiseAbs() - Vector3d(0.1, 0.05, 0.02)).maxCoeff(), 1e-9);
    EXPECT_NEAR((turn.inverse() * near[0].p_A_W).z(), 0.0, 1e-9);
    fall.monitor->reset();
  }
}

}  // namespace sdf_ccd::half_space_limits_test
