#include "shell/point_shell.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "oracle/random.h"

namespace sdf_ccd::packed_normal_test {

using Real = long double;

/// The angle between a unit vector and what it is packed to [rad].
double error(const Vector3d& n) {
  const Eigen::Matrix<Real, 3, 1> a = n.cast<Real>(), b = PackedNormal(n).vector().cast<Real>();
  return static_cast<double>(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// A local maximum of the error, by ever shorter random steps.
double climb(Vector3d n, test::Random& random) {
  double best = error(n);
  for (double step = 1e-4; step > 1e-7; step *= 0.9) {
    for (int i = 0; i < 8; ++i) {
      const Vector3d tried = (n + step * test::direction(random)).normalized();
      if (const double at = error(tried); at > best) {
        best = at;
        n = tried;
      }
    }
  }
  return best;
}

/// The bound is reached at the middle of the octahedron's faces, and nowhere exceeded.
TEST(PackedNormal, LargestErrorIsAsBounded) {
  test::Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) worst = std::max(worst, climb(test::direction(random), random));
  for (int face = 0; face < 8; ++face) {
    const Vector3d middle(face & 1 ? -1 : 1, face & 2 ? -1 : 1, face & 4 ? -1 : 1);
    for (int i = 0; i < 50; ++i)
      worst = std::max(worst, climb((middle + 1e-2 * test::direction(random)).normalized(), random));
  }
  EXPECT_LE(worst, PackedNormal::kMaxError);
  EXPECT_GE(worst, 0.95 * PackedNormal::kMaxError);
}

/// Along the edges of the octahedron, where the square is folded, and at its corners.
TEST(PackedNormal, EdgesAndAxesOfTheOctahedron) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vector3d n = sign * Vector3d::Unit(axis);
      EXPECT_EQ(PackedNormal(n).vector(), n);
      EXPECT_EQ(PackedNormal(1e-200 * n).vector(), n);
      for (const double other : {-1.0, 1.0}) {
        for (int i = 0; i <= 1000; ++i) {
          const Vector3d to = other * Vector3d::Unit((axis + 1) % 3);
          for (const double aside : {-1e-9, 0.0, 1e-9}) {
            const Vector3d on_edge = (1.0 - 1e-3 * i) * n + 1e-3 * i * to + aside * Vector3d::Unit((axis + 2) % 3);
            EXPECT_LE(error(on_edge.normalized()), PackedNormal::kMaxError);
          }
        }
      }
    }
  }
}

TEST(PackedNormal, PackingAgainChangesNothing) {
  test::Random random(2);
  for (int i = 0; i < 100000; ++i) {
    const Vector3d once = PackedNormal(test::direction(random)).vector();
    EXPECT_LT((PackedNormal(once).vector() - once).norm(), 1e-15);
  }
}

TEST(PackedNormal, EveryPatternOfBitsIsAUnitVector) {
  for (const int u : {-32768, -32767, -1, 0, 1, 32767}) {
    for (int v = -32768; v < 32768; ++v) {
      PackedNormal normal;
      normal.u = static_cast<std::int16_t>(u);
      normal.v = static_cast<std::int16_t>(v);
      ASSERT_NEAR(normal.vector().norm(), 1.0, 1e-15);
    }
  }
}

TEST(PackedNormal, WhatIsNoDirectionIsUp) {
  const double infinity = HUGE_VAL;
  for (const Vector3d& none : {Vector3d(0, 0, 0), Vector3d(infinity, 0, 0), Vector3d(0, std::nan(""), 1)})
    EXPECT_EQ(PackedNormal(none).vector(), Vector3d::UnitZ());
}

}  // namespace sdf_ccd::packed_normal_test
