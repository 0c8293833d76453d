#include <gtest/gtest.h>

#include <algorithm>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/monitor.h"
#include "shell/point_shell.h"

namespace sdf_ccd::point_rounding_test {

using namespace test;

/// The lowest corner of a rotated box [m], in long double.
double lowestCorner(const Vector3d& half, const Matrix3d& R) {
  using Real = long double;
  Real below = 0.0;
  for (int axis = 0; axis < 3; ++axis) below += std::abs(static_cast<Real>(R(2, axis)) * static_cast<Real>(half[axis]));
  return static_cast<double>(-below);
}

/// A box above a plane, which its true corners do not reach, or just do. Points that were rounded out of the box do.
TEST(PointRounding, ProvesNoContactAndHidesNone) {
  const Vector3d half(0.1, 0.2, 0.3);
  const auto scene =
      build({body("ground", ground(), true), body("box", Primitive(Box::fromSize(2.0 * half)))}, fine(0.05));
  const PointShell& shell = *scene->bodies[1].shell;
  const double error = shell.position_error;
  ASSERT_GT(error, 1e-9);
  ASSERT_LT(error, 3e-8);
  Monitor monitor(scene, soft());
  Random random(6);
  int rounded_inside = 0;
  for (int i = 0; i < 200; ++i) {
    const Isometry3d rotation = test::pose(random, 3.0, 0.0);
    const auto verdictAt = [&](double distance) {
      Isometry3d X_WB = rotation;
      X_WB.translation().z() = distance - lowestCorner(half, X_WB.linear());
      double least = distance;
      for (const Vector3d& p : shell.points()) least = std::min(least, (X_WB * p).z());
      rounded_inside += distance > 0.0 && least < -1e-10;
      monitor.reset();
      return monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(X_WB)}), {}).pairs[0].verdict;
    };
    EXPECT_NE(verdictAt(1e-12), Verdict::kContact);
    EXPECT_NE(verdictAt(-1e-12), Verdict::kClear);
    EXPECT_EQ(verdictAt(-2.1 * error), Verdict::kContact);
  }
  EXPECT_GT(rounded_inside, 20);
}

}  // namespace sdf_ccd::point_rounding_test
