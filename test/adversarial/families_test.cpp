#include <gtest/gtest.h>

#include "adversarial/family.h"
#include "oracle/convex.h"
#include "oracle/integer_sweep.h"
#include "oracle/pair_motion.h"
#include "oracle/random.h"
#include "oracle/shapes.h"

namespace sdf_ccd::test {

/// What a test prints of its family.
void PrintTo(const Family& family, std::ostream* out) {
  *out << family.name;
}

namespace {

class Families : public ::testing::TestWithParam<Family> {};

/// A small part of the study `truth`.
TEST_P(Families, NeverMakeAVerdictUntrue) {
  const Family& family = GetParam();
  const Tally tally = family.run(1, family.fast_cases);
  for (const auto& [what, failure] : tally.failures)
    ADD_FAILURE() << failure.count << " of " << tally.cases << ": " << what << ", the first " << failure.first;
  EXPECT_TRUE(tally.holds());
  // The cases must be mixed: if all were clear, or all uncertain, they would prove nothing.
  EXPECT_GE(tally.cases, family.fast_cases);
  EXPECT_GT(tally.clear, tally.cases / 50);
  EXPECT_GT(tally.contact, tally.cases / 50);
}

INSTANTIATE_TEST_SUITE_P(Adversarial, Families, ::testing::ValuesIn(families()),
                         [](const auto& info) { return std::string(info.param.name); });

TEST(Oracle, SeparationOfBoxesIsTheirDistanceOrDepth) {
  const Pieces box{convexOf(boxMesh({1, 1, 1}))};
  const auto at = [](Real x, Real y) { return LongPose(Matrix3l::Identity(), Vector3l(x, y, 0)); };
  EXPECT_NEAR(double(separation(box, {}, box, at(2.5L, 0)).value), 0.5, 1e-15);
  EXPECT_NEAR(double(separation(box, {}, box, at(1.5L, 1)).value), -0.5, 1e-15);
  EXPECT_NEAR(double(surfaceDistance(box, {}, box, at(5, 6))), 5.0, 1e-15);
  EXPECT_NEAR(double(separation(box, {}, box, at(2.5L, 0)).axis_W.x()), 1.0, 1e-15);
}

TEST(Oracle, ScrewsEndWhereTheyShould) {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Isometry3d start = pose(random, 3.0, 1.0), end = pose(random, i % 2 ? 3.0 : 1e-9, 1.0);
    const LongScrew screw(start, end);
    const Vector3l p(0.3L, -0.2L, 0.5L);
    EXPECT_LT(double((screw.pose(1) * p - LongPose(end) * p).norm()), 1e-15);
    // The speed equals a difference quotient of poses.
    const Real h = 1e-6L;
    const Real speed = (screw.pose(0.3L + h) * p - screw.pose(0.3L - h) * p).norm() / (2 * h);
    EXPECT_NEAR(double(speed), double(screw.speed(p)), 1e-8);
  }
}

TEST(Oracle, LeastValueIsBracketed) {
  const auto f = [](Real x) { return (x - 0.3L) * (x - 0.3L) - 0.01L; };
  const LeastValue least = leastValue(f, 0, 1, 1.4L, {1e-6L});
  EXPECT_LE(double(least.low), -0.01);
  EXPECT_GE(double(least.high), -0.01);
  EXPECT_LE(double(least.high - least.low), 1e-6);
}

TEST(Oracle, NowhereInAMotionAreBodiesNearerThanItsLeast) {
  Random random(5);
  const Pieces a{convexOf(boxMesh({0.5, 0.3, 0.1})), convexOf(translated(boxMesh({0.1, 0.1, 0.4}), {0.6, 0, 0.2}))};
  const Pieces b{convexOf(boxMesh({0.2, 0.2, 0.2})), ball(0.3)};
  for (int i = 0; i < 40; ++i) {
    const double angle = i % 4 == 0 ? 0.0 : i % 4 == 1 ? 1e-3 : 2.0;
    const Isometry3d X_WA = pose(random, 3.0, 0.8), X_WB = pose(random, 3.0, 0.8);
    const PairMotion motion(a, b, {0.0, 1.0}, {X_WA, X_WA * pose(random, angle, 0.5)},
                            {X_WB, X_WB * pose(random, angle, 0.5)});
    const LeastValue least = motion.least({1e-4L});
    EXPECT_LE(double(least.high - least.low), 1e-4);
    EXPECT_NEAR(double(motion.at(least.at).value), double(least.high), 1e-15);
    for (int k = 0; k <= 2000; ++k) EXPECT_GE(double(motion.at(k / 2000.0L).value - least.low), -1e-15);
  }
}

TEST(Oracle, SlidingAlongAFaceNeedsNoSearch) {
  const Pieces box{convexOf(boxMesh({1, 1, 1}))};
  Isometry3d X_WB = Isometry3d::Identity();
  X_WB.translation() = Vector3d(-1.0, 0.3, 2.0);
  Isometry3d X_WB_end = X_WB;
  X_WB_end.translation().x() = 1.0;
  const PairMotion motion(box, box, {0.0, 1.0}, {2, Isometry3d::Identity()}, {X_WB, X_WB_end});
  LeastOptions few;
  few.max_samples = 8;
  const LeastValue least = motion.least(few);
  EXPECT_EQ(double(least.low), 0.0);
  EXPECT_EQ(double(least.high), 0.0);
}

TEST(Oracle, SweepsTellTouchFromOverlap) {
  const WholeConvex a = wholeConvexOf(boxMesh({4, 4, 4}), 1.0), b = wholeConvexOf(boxMesh({2, 2, 2}), 1.0);
  const auto at = [&](int x, int y) {
    WholeConvex moved = b;
    for (Vector3w& p : moved.corners) p += Vector3w(x, y, 0);
    return moved;
  };
  EXPECT_EQ(sweep(a, at(6, -20), Vector3w(0, 40, 0)), Sweep::kTouch);
  EXPECT_EQ(sweep(a, at(7, -20), Vector3w(0, 40, 0)), Sweep::kApart);
  EXPECT_EQ(sweep(a, at(5, -20), Vector3w(0, 40, 0)), Sweep::kOverlap);
  EXPECT_EQ(sweep(a, at(12, 0), Vector3w(-6, 6, 0)), Sweep::kTouch);
}

}  // namespace
}  // namespace sdf_ccd::test
