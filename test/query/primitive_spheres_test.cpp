#include "query/primitive_spheres.h"

#include <cmath>

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "query/swept_side.h"

namespace sdf_ccd::primitive_spheres_test {

using test::Random;
using Real = long double;
using Vector3l = Eigen::Matrix<Real, 3, 1>;

struct Distance {
  Vector3l p;

  static Real corner(Real x, Real y) {
    return std::hypot(std::max(x, 0.0L), std::max(y, 0.0L)) + std::min(std::max(x, y), 0.0L);
  }
  Real operator()(const Sphere& sphere) const { return p.norm() - sphere.radius; }
  Real operator()(const Box& box) const {
    const Vector3l q = p.cwiseAbs() - box.halfSize().cast<Real>();
    return q.cwiseMax(0.0L).norm() + std::min(q.maxCoeff(), 0.0L);
  }
  Real operator()(const Cylinder& cylinder) const {
    return corner(std::hypot(p.x(), p.y()) - cylinder.radius, std::abs(p.z()) - cylinder.halfLength());
  }
  Real operator()(const HalfSpace& plane) const { return plane.normal.cast<Real>().dot(p) - plane.offset; }
};

Vector3l placed(const Isometry3d& X, const Vector3d& p) {
  return X.linear().cast<Real>() * p.cast<Real>() + X.translation().cast<Real>();
}

/// Points that start within rounding of the surface, with no margin at all: of small and large bodies, of shells whose
/// points lie far from their frame's origin, and beside planes that are far from theirs.
TEST(PrimitiveSpheres, SidesHoldWithinRounding) {
  Random random(11);
  const auto power = [&](double least, double most) { return std::pow(10.0, test::uniform(random, least, most)); };
  long inside = 0, outside = 0;
  for (int trial = 0; trial < 40000; ++trial) {
    const double size = power(-4.0, 3.0);
    const HalfSpace plane{test::direction(random), (trial % 8 ? 0.0 : 1e6) * test::uniform(random, -1.0, 1.0)};
    const Primitive primitive =
        trial % 4 == 0   ? Primitive(plane)
        : trial % 4 == 1 ? Primitive(Sphere{size})
        : trial % 4 == 2 ? Primitive(Box::fromSize(2.0 * size * Vector3d(1.0, power(-3.0, 0.0), power(-3.0, 0.0))))
                         : Primitive(Cylinder::fromRadiusAndLength(size, 2.0 * size * power(-3.0, 3.0)));
    const BoundingBall shell{(trial % 3 ? 0.0 : power(-2.0, 6.0)) * test::direction(random), size * power(-3.0, 1.0)};
    // A point of the shell starts at a point of the surface, within some roundings of it.
    Vector3d on = 3.0 * size * test::direction(random);
    for (int i = 0; i < 60; ++i) on -= signedDistance(primitive, on) * distanceGradient(primitive, on);
    const Vector3d p = shell.center + shell.radius * test::direction(random);
    Chord chord{0.0, 1.0, test::pose(random, 3.0, 0.0), {}, 0};
    const double off = std::pow(10.0, test::uniform(random, -17.0, -4.0)) * (size + shell.center.norm());
    const Vector3d to = on + (trial % 2 ? off : -off) * distanceGradient(primitive, on);
    chord.X_FP_start.translation() = to - chord.X_FP_start.linear() * p;
    chord.X_FP_end = chord.X_FP_start;
    if (trial % 5) chord.X_FP_end.translation() += 0.5 * off * test::direction(random);
    SphereGroup group;
    for (int i = 0; i < 7; ++i) group.add(p, 0.0);
    PrimitiveSpheres(primitive, chord, 0.0, shell).test(group);
    for (int i = 0; i < group.size; ++i) {
      const SweptSide side = group.sideOf(i);
      if (side == SweptSide::kUnknown) continue;
      (side == SweptSide::kInside ? inside : outside) += 1;
      for (int s = 0; s <= 8; ++s) {
        const Vector3l at =
            placed(chord.X_FP_start, p) + s / 8.0L * (placed(chord.X_FP_end, p) - placed(chord.X_FP_start, p));
        const Real distance = std::visit(Distance{at}, primitive);
        if (side == SweptSide::kInside) {
          ASSERT_LT(distance, 0.0L) << "trial " << trial << ", at " << s / 8.0;
        } else {
          ASSERT_GT(distance, 0.0L) << "trial " << trial << ", at " << s / 8.0;
        }
      }
    }
  }
  EXPECT_GT(inside, 15000);
  EXPECT_GT(outside, 15000);
}

}  // namespace sdf_ccd::primitive_spheres_test
