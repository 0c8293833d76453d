#include "contact/chord_impulses.h"

#include <gtest/gtest.h>

#include "oracle/contact_case.h"
#include "oracle/random.h"

namespace sdf_ccd::chord_impulses_test {

using namespace test;

/// Each impulse turned by itself, in long double.
struct SumByItself {
  Eigen::Matrix<long double, 3, 1> impulse = Eigen::Matrix<long double, 3, 1>::Zero(), moment = impulse;

  void add(const Isometry3d& X_CF, const Vector3d& p_F, const Vector3d& impulse_F) {
    const auto R_CF = X_CF.linear().cast<long double>();
    const Eigen::Matrix<long double, 3, 1> turned = R_CF * impulse_F.cast<long double>();
    const Eigen::Matrix<long double, 3, 1> r_C =
        R_CF * p_F.cast<long double>() + X_CF.translation().cast<long double>();
    impulse += turned;
    moment += r_C.cross(turned);
  }
};

/// More times than are kept at once, over two chords, of a frame that turns; near its origin, and as far from it as
/// a map in geodetic coordinates has its origin.
TEST(ChordImpulses, AreTheSumOfImpulsesTurnedByThemselves) {
  Random random(7);
  for (const double far : {0.0, 1e3, 5e6}) {
    const Vector3d place_F = far * direction(random);
    // C's origin is near the points.
    const auto poseNear = [&](double angle) {
      const Eigen::AngleAxisd turn(angle, Vector3d(1, 2, 3).normalized());
      return Isometry3d(Eigen::Translation3d(Vector3d(0.1, 0.2, 0.3) - turn * place_F) * turn);
    };
    Wrench sum_C;
    SumByItself expected;
    ChordImpulses impulses(sum_C);
    double size = 0.0;
    for (int chord = 0; chord < 2; ++chord) {
      // Far away a turn would displace C's origin, too.
      const double turn = far == 0.0 ? 0.4 : 0.0;
      const ChordFrame frame(poseNear(chord * turn), poseNear((chord + 1) * turn));
      impulses.begin(frame);
      for (int i = 0; i < 400; ++i) {
        const double s = double(i % 3 == 0 ? i % 23 : i % 2) / 23.0;
        const Vector3d p_F = place_F + uniformIn(random, {Vector3d::Constant(-1.0), Vector3d::Constant(1.0)});
        const Vector3d impulse_F = uniformIn(random, {Vector3d::Constant(-2.0), Vector3d::Constant(5.0)});
        impulses.add(s, p_F, impulse_F);
        EXPECT_EQ(impulses.poseAt(s).matrix(), frame.pose(s).matrix());
        expected.add(frame.pose(s), p_F, impulse_F);
        size += impulse_F.norm();
      }
    }
    impulses.finish();
    // A point's place is rounded to the spacing of doubles there.
    const double rounding = 1e-15 * (far + 10.0) * size;
    EXPECT_LT((sum_C.force - expected.impulse.cast<double>()).norm(), 1e-13 * size) << far;
    EXPECT_LT((sum_C.torque - expected.moment.cast<double>()).norm(), rounding) << far;
    const Wrench before = sum_C;
    impulses.finish();
    EXPECT_EQ(sum_C.force, before.force) << "added twice";
  }
}

}  // namespace sdf_ccd::chord_impulses_test
