#include "motion/chords.h"

#include <gtest/gtest.h>

#include "oracle/random.h"
#include "oracle/screw_chords.h"

namespace sdf_ccd::chords_test {

using test::Random;

Isometry3d turned(const Vector3d& axis, double angle, const Vector3d& p = Vector3d::Zero()) {
  Isometry3d X = Isometry3d::Identity();
  X.linear() = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  X.translation() = p;
  return X;
}

TEST(ScrewMotion, EndsAreExact) {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const Isometry3d a = test::pose(random, 3.1, 2.0), b = test::pose(random, i % 2 ? 3.1 : 1e-7, 2.0);
    const ScrewMotion motion(a, b);
    EXPECT_EQ(motion.pose(0).matrix(), a.matrix());
    EXPECT_EQ(motion.pose(1).matrix(), b.matrix());
    // Continuous at the end: the twist really leads there.
    EXPECT_TRUE(motion.pose(1.0 - 1e-9).isApprox(b, 1e-7));
  }
}

TEST(ScrewMotion, TheTwistLeadsToTheEndAndTheMiddleLiesHalfWay) {
  Random random(5);
  for (int i = 0; i < 4000; ++i) {
    const double angle =
        i % 2 ? std::pow(10.0, -test::uniform(random, 0.0, 16.0)) : test::uniform(random, 0.0, 3.14159);
    const Isometry3d a = test::pose(random, 3.1, 2.0);
    const Isometry3d b =
        a * turned(test::direction(random), angle, test::uniform(random, 0.0, 2.0) * test::direction(random));
    const ScrewMotion motion(a, b);
    EXPECT_LT((motion.pose(std::nextafter(1.0, 0.0)).matrix() - b.matrix()).norm(), 1e-14 + 1e-15 / (3.1416 - angle));
    EXPECT_LT((motion.pose(0.5).matrix() - motion.pose(std::nextafter(0.5, 0.0)).matrix()).norm(), 1e-14) << angle;
  }
}

TEST(ScrewMotion, RevoluteJointGivesAnArcAboutItsAxis) {
  // F rests; P rotates by a right angle about an axis through (1, 0, 0).
  const Vector3d center(1, 0, 0);
  const auto about = [&](double angle) {
    Isometry3d X = turned({0, 0, 1}, angle);
    X.translation() = center - X.linear() * center;
    return X;
  };
  const ScrewMotion motion(about(0), about(1.5707963267948966));
  for (double s = 0; s <= 1; s += 0.125) {
    EXPECT_TRUE(motion.pose(s).isApprox(about(s * 1.5707963267948966), 1e-12));
  }
  EXPECT_NEAR(motion.angle(), 1.5707963267948966, 1e-12);
}

TEST(ScrewMotion, SameMotionSeenFromTheOtherBody) {
  Random random(2);
  for (int i = 0; i < 200; ++i) {
    const Isometry3d a = test::pose(random, 3.0, 1.0), b = a * test::pose(random, 2.0, 1.0);
    const ScrewMotion there(a, b), back(a.inverse(), b.inverse());
    for (const double s : {0.2, 0.5, 0.9}) EXPECT_TRUE(there.pose(s).isApprox(back.pose(s).inverse(), 1e-9));
  }
}

TEST(ScrewMotion, VelocityIsTheDerivative) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const ScrewMotion motion(test::pose(random, 3.0, 1.0), test::pose(random, 3.0, 1.0));
    const Vector3d p = test::direction(random);
    const double s = test::uniform(random, 0.1, 0.9), h = 1e-6;
    const Vector3d difference = (motion.pose(s + h) * p - motion.pose(s - h) * p) / (2 * h);
    EXPECT_LT((difference - motion.velocity(s, p)).norm(), 1e-7);
  }
}

TEST(ScrewMotion, RefusesBadPoses) {
  Isometry3d bad = Isometry3d::Identity();
  bad.translation().x() = NAN;
  EXPECT_THROW(ScrewMotion(Isometry3d::Identity(), bad), std::invalid_argument);
  bad = Isometry3d::Identity();
  bad.linear() *= 1.1;
  EXPECT_THROW(ScrewMotion(bad, Isometry3d::Identity()), std::invalid_argument);
  bad = Isometry3d::Identity();
  bad.linear()(0, 0) = -1;
  EXPECT_THROW(ScrewMotion(bad, Isometry3d::Identity()), std::invalid_argument);
}

TEST(Chords, ErrorIsABoundAndNotALooseOne) {
  Random random(4);
  double worst_share = 0.0;
  for (int i = 0; i < 300; ++i) {
    const Isometry3d a = test::pose(random, 3.0, 1.0);
    const Isometry3d b = a * test::pose(random, 3.0, i % 2 ? 1.0 : 0.0);
    const BoundingBall ball{test::direction(random) * test::uniform(random, 0, 1), test::uniform(random, 0, 0.5)};
    const ChordPath path = test::screwChords({a, b}, ball, {test::uniform(random, 1e-4, 1e-1), 1000});
    const ScrewMotion screw(a, b);
    for (int k = 0; k < 100; ++k) {
      const Vector3d p = ball.center + ball.radius * test::direction(random);
      const Chord& chord = path.chords[random() % path.chords.size()];
      const double s = test::uniform(random, 0, 1);
      const Vector3d on_chord = (1 - s) * (chord.X_FP_start * p) + s * (chord.X_FP_end * p);
      const Vector3d on_arc = screw.pose(chord.t_start + s * (chord.t_end - chord.t_start)) * p;
      const double deviation = (on_chord - on_arc).norm();
      ASSERT_LE(deviation, path.error + 1e-12);
      worst_share = std::max(worst_share, deviation / path.error);
    }
  }
  EXPECT_GT(worst_share, 0.9);
}

/// Both bodies rotate about their origins, which move straight: their relative motion is no screw.
TEST(Chords, ErrorIsABoundForDriftingBodies) {
  Random random(5);
  double worst_share = 0.0;
  const auto at = [](const Isometry3d& start, const Isometry3d& end, double s) {
    Isometry3d X = Isometry3d::Identity();
    X.linear() = Quaterniond(start.linear()).slerp(s, Quaterniond(end.linear())).toRotationMatrix();
    X.translation() = (1 - s) * start.translation() + s * end.translation();
    return X;
  };
  for (int i = 0; i < 1000; ++i) {
    const double turn_F = i % 4 == 0 ? 0.0 : 3.0, turn_P = i % 4 == 1 ? 0.0 : 3.0;
    const Isometry3d F0 = test::pose(random, 3.0, 1.0), P0 = test::pose(random, 3.0, 1.0);
    Isometry3d F1 = F0 * test::pose(random, turn_F, i % 3 ? 1.0 : 0.0), P1 = P0 * test::pose(random, turn_P, 1.0);
    const BoundingBall ball{test::direction(random) * test::uniform(random, 0, 0.3), test::uniform(random, 0, 0.5)};
    ChordPath path;
    addChords({0.0, 1.0, F0, F1, P0, P1}, ball, {test::uniform(random, 1e-4, 1e-1), 1000}, 0, path);
    ASSERT_EQ(path.chords.back().t_end, 1.0);
    for (int k = 0; k < 100; ++k) {
      const Vector3d p = ball.center + ball.radius * test::direction(random);
      const Chord& chord = path.chords[random() % path.chords.size()];
      const double s = test::uniform(random, 0, 1), t = chord.t_start + s * (chord.t_end - chord.t_start);
      const Vector3d on_chord = (1 - s) * (chord.X_FP_start * p) + s * (chord.X_FP_end * p);
      const double deviation = (on_chord - at(F0, F1, t).inverse() * (at(P0, P1, t) * p)).norm();
      ASSERT_LE(deviation, path.error + 1e-12);
      worst_share = std::max(worst_share, deviation / path.error);
    }
  }
  EXPECT_GT(worst_share, 0.8);
}

TEST(Chords, RightAngleWithinOneCycleKeepsTheTolerance) {
  const ChordPath path = test::screwChords({Isometry3d::Identity(), turned({0, 0, 1}, 1.5707963267948966)},
                                           {Vector3d::Zero(), 0.5}, {1e-4, 1000}, 0.1);
  EXPECT_LE(path.error, 1e-4);
  EXPECT_GT(path.error, 0.5e-4);
  EXPECT_EQ(path.chords.size(), 40U);  // √(0.5 (π/2)² / 8e-4) = 39.3
  EXPECT_EQ(path.chords.back().t_end, 0.1);
  EXPECT_EQ(path.chords.front().t_start, 0.0);
  for (std::size_t i = 1; i < path.chords.size(); ++i) {
    EXPECT_EQ(path.chords[i].t_start, path.chords[i - 1].t_end);
    EXPECT_EQ(path.chords[i].X_FP_start.matrix(), path.chords[i - 1].X_FP_end.matrix());
  }
}

TEST(Chords, TranslationNeedsOneChordAndHasNoError) {
  const ChordPath path = test::screwChords({Isometry3d::Identity(), turned({1, 0, 0}, 0.0, {5, 1, 2})},
                                           {Vector3d::Zero(), 1.0}, {1e-6, 1000});
  EXPECT_EQ(path.chords.size(), 1U);
  EXPECT_LT(path.error, 1e-15);
}

TEST(Chords, CapLeavesItsErrorInTheBound) {
  const ChordPath path =
      test::screwChords({Isometry3d::Identity(), turned({0, 0, 1}, 3.0)}, {Vector3d::Zero(), 1.0}, {1e-9, 10});
  EXPECT_EQ(path.chords.size(), 10U);
  EXPECT_NEAR(path.error, 9.0 / 800.0, 1e-12);
}

}  // namespace sdf_ccd::chords_test
