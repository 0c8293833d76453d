#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

#include "oracle/scene_case.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"

namespace sdf_ccd::margin_test {

using namespace test;

using SharedScene = std::shared_ptr<const Scene>;

/// A ball of 0.1 m above something that fills z <= 0.
SharedScene ballAbove(const BodyDescription& below) {
  return build({body("ball", Primitive(Sphere{0.1})), below});
}

/// The ball moves at a height, at a distance from the other body's origin.
CycleResult slide(const SharedScene& scene, double height, double far, double margin) {
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.X_WB = {{translation({far, 0, height + 0.1}), translation({far, 1, height + 0.1})}, {Isometry3d::Identity()}};
  CycleRequest request;
  request.margin = margin;
  return checkMotion(scene, {}, planThrough(motion), request);
}

/// The same of two motions of a planner, one of which is as above.
MotionVerdict slideAmongMany(const SharedScene& scene, double height, double far, double margin) {
  MotionsRequest request;
  request.margin = margin;
  return checkMotions(
             scene, {}, 2,
             [&](std::size_t i, double) {
               CycleMotion motion;
               motion.times = {0.0, 1.0};
               const double at = height + 0.1 + double(i);
               motion.X_WB = {{translation({far, 0, at}), translation({far, 1, at})}, {Isometry3d::Identity()}};
               return planThrough(motion);
             },
             request)
      .at(0);
}

BodyDescription plane() {
  return body("below", ground(), true);
}
BodyDescription block() {
  BodyDescription block = body("below", Primitive(Box::fromSize({3.0, 3.0, 1.0})), true);
  block.geometry[0].X_BG = translation({0, 0, -0.5});
  return block;
}

/// A margin is a distance, not a tilt of the plane about its origin.
TEST(Margin, HoldsFarFromAPlanesOrigin) {
  const SharedScene scene = ballAbove(plane());
  for (const double far : {0.0, 10.0, 1000.0}) {
    EXPECT_EQ(slide(scene, 0.052, far, 0.05).verdict, Verdict::kClear) << far;
    EXPECT_EQ(slide(scene, 0.048, far, 0.05).verdict, Verdict::kUncertain) << far;
    EXPECT_EQ(slide(scene, -0.048, far, 0.05).verdict, Verdict::kUncertain) << far;
    EXPECT_EQ(slide(scene, -0.052, far, 0.05).verdict, Verdict::kContact) << far;
    EXPECT_EQ(slideAmongMany(scene, 0.052, far, 0.05).verdict, Verdict::kClear) << far;
    EXPECT_EQ(slideAmongMany(scene, 0.048, far, 0.05).verdict, Verdict::kUncertain) << far;
  }
}

TEST(Margin, IsInNoErrorBound) {
  for (const SharedScene& scene : {ballAbove(plane()), ballAbove(block())}) {
    for (const double height : {3.0, 0.052, 0.03, 0.01, -0.03, -0.08}) {
      const CycleResult with = slide(scene, height, 0.0, 0.05), without = slide(scene, height, 0.0, 0.0);
      ASSERT_EQ(with.pairs.size(), 1U);
      // The error of a pair that stays UNCERTAIN says how near the surfaces come beyond the margin, as far as that is
      // searched for.
      if (with.verdict != Verdict::kUncertain) {
        EXPECT_LT(with.error_bound, 2e-3) << height;
        EXPECT_LT(with.pairs[0].error.total(), 2e-3) << height;
      }
      if (with.verdict == without.verdict) {
        EXPECT_NEAR(with.error_bound, without.error_bound, 1e-9) << height;
      }
      const MotionVerdict among = slideAmongMany(scene, height, 0.0, 0.05);
      EXPECT_EQ(among.verdict, with.verdict) << height;
      if (among.verdict != Verdict::kUncertain) {
        EXPECT_LT(among.error_bound, 2e-3) << height;
      }
    }
  }
}

/// The second cycle of a pair is decided by what is left of its clearance.
TEST(Margin, HoldsForPairsThatAreNotTestedAgain) {
  const auto scene = build({body("ball", Primitive(Sphere{0.1})), block()});
  Monitor monitor(scene, {});
  const auto at = [&](double height) {
    return cycle(1.0, {still(translation({0, 0, height + 0.1})), still(Isometry3d::Identity())});
  };
  CycleRequest request;
  const auto verdict = [&](double height, double margin) {
    request.margin = margin;
    const CycleResult& result = monitor.run(at(height), request);
    if (result.verdict == Verdict::kClear) {
      EXPECT_LT(result.error_bound, 1e-3);
      EXPECT_LE(result.pairs[0].clearance, height + 1e-9);
    }
    return result.verdict;
  };
  EXPECT_EQ(verdict(0.3, 0.0), Verdict::kClear);
  EXPECT_EQ(verdict(0.3, 0.0), Verdict::kClear);
  EXPECT_EQ(monitor.run(at(0.3), request).skipped, 1);
  EXPECT_EQ(verdict(0.3, 0.29), Verdict::kClear);
  EXPECT_EQ(verdict(0.3, 0.31), Verdict::kUncertain);
  EXPECT_EQ(verdict(0.3, 0.31), Verdict::kUncertain);
  EXPECT_EQ(verdict(0.3, 0.1), Verdict::kClear);
  EXPECT_EQ(verdict(0.15, 0.1), Verdict::kClear);
  EXPECT_EQ(verdict(0.05, 0.1), Verdict::kUncertain);
  EXPECT_EQ(verdict(0.05, 0.0), Verdict::kClear);
  request.max_time = 1e-9;
  EXPECT_EQ(verdict(0.05, 0.1), Verdict::kUncertain);
}

TEST(Margin, IsRefusedIfItIsNone) {
  const SharedScene scene = ballAbove(plane());
  for (const double wrong : {-1.0, 1e10, std::nan("")})
    EXPECT_THROW(slide(scene, 1.0, 0.0, wrong), std::invalid_argument) << wrong;
}

}  // namespace sdf_ccd::margin_test
