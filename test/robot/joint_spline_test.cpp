#include "robot/joint_spline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "oracle/random.h"

namespace sdf_ccd::joint_spline_test {

using test::Random;
using test::uniform;

JointSplinePoint anyKnot(Random& random) {
  return {uniform(random, -3, 3), uniform(random, -2, 2), uniform(random, -5, 5)};
}

/// Derivatives, by differences of positions.
double velocityOf(const JointSpline& spline, double time) {
  return (spline.position(time + 1e-5) - spline.position(time - 1e-5)) / 2e-5;
}
double accelerationOf(const JointSpline& spline, double time) {
  constexpr double h = 1e-4;
  return (spline.position(time + h) - 2.0 * spline.position(time) + spline.position(time - h)) / (h * h);
}

TEST(JointSpline, HasWhatIsGivenAtBothEnds) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const JointSplinePoint start = anyKnot(random), end = anyKnot(random);
    const double T = uniform(random, 0.5, 3.0);
    for (const JointSplineOrder order :
         {JointSplineOrder::kLinear, JointSplineOrder::kCubic, JointSplineOrder::kQuintic}) {
      const JointSpline spline(order, start, end, T);
      EXPECT_NEAR(spline.position(0.0), start.position, 1e-12);
      EXPECT_NEAR(spline.position(T), end.position, 1e-12 * (1.0 + T * T) * 100);
      if (order == JointSplineOrder::kLinear) {
        EXPECT_NEAR(spline.position(0.3 * T), 0.7 * start.position + 0.3 * end.position, 1e-12);
        EXPECT_EQ(spline.largestAcceleration(), 0.0);
        continue;
      }
      EXPECT_NEAR(velocityOf(spline, 0.0), start.velocity, 1e-6);
      EXPECT_NEAR(velocityOf(spline, T), end.velocity, 1e-6);
      if (order == JointSplineOrder::kCubic) continue;
      EXPECT_NEAR(accelerationOf(spline, 0.0), start.acceleration, 1e-3);
      EXPECT_NEAR(accelerationOf(spline, T), end.acceleration, 1e-3);
    }
  }
}

TEST(JointSpline, PiecesStrayByNoMoreThanTheToleranceAndNotMuchLess) {
  Random random(3);
  double largest = 0.0;
  for (int i = 0; i < 200; ++i) {
    const JointSplinePoint start = anyKnot(random), end = anyKnot(random);
    const double T = uniform(random, 0.1, 3.0), tolerance = std::pow(10.0, uniform(random, -5.0, -2.0));
    const JointSpline spline(i % 2 ? JointSplineOrder::kCubic : JointSplineOrder::kQuintic, start, end, T);
    const int pieces = piecesWithin(spline, T, tolerance);
    double worst = 0.0;
    for (int k = 0; k < pieces; ++k) {
      const double t0 = T * k / pieces, t1 = T * (k + 1) / pieces;
      const double q0 = spline.position(t0), q1 = spline.position(t1);
      for (const double x : {0.25, 0.5, 0.75}) {
        worst = std::max(worst, std::abs(spline.position(t0 + x * (t1 - t0)) - (q0 + x * (q1 - q0))));
      }
    }
    EXPECT_LE(worst, tolerance);
    if (pieces > 3) largest = std::max(largest, worst / tolerance);
  }
  EXPECT_GT(largest, 0.7);
}

TEST(JointSpline, WhatCannotBeCutFineEnoughIsRefused) {
  const JointSpline wild(JointSplineOrder::kCubic, {0.0, 1e9, 0.0}, {0.0, -1e9, 0.0}, 1000.0);
  EXPECT_THROW(piecesWithin(wild, 1000.0, 1e-6), std::invalid_argument);
  const JointSpline none(JointSplineOrder::kCubic, {0.0, NAN, 0.0}, {0.0, 0.0, 0.0}, 1.0);
  EXPECT_THROW(piecesWithin(none, 1.0, 1e-6), std::invalid_argument);
}

}  // namespace sdf_ccd::joint_spline_test
