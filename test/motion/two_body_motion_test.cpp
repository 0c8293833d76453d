#include "motion/two_body_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "motion/chain_derivatives.h"
#include "motion/chords.h"
#include "oracle/long_screw.h"
#include "oracle/random.h"

namespace sdf_ccd::two_body_motion_test {

using test::Random;

/// A body that rotates about an axis of the world and slides along it, computed without logarithms.
struct Screw {
  Vector3d axis, through;
  double angle, slide;
  Isometry3d X_WB;  ///< at s = 0

  Isometry3d pose(double s) const {
    const Isometry3d turn(Eigen::Translation3d(through + s * slide * axis) * Eigen::AngleAxisd(s * angle, axis) *
                          Eigen::Translation3d(-through));
    return turn * X_WB;
  }
};

Screw randomScrew(Random& random, double most) {
  const auto somewhere = [&] { return Vector3d(test::uniform(random, 0.0, 1.5) * test::direction(random)); };
  const double angle = test::uniform(random, -most, most);
  return {test::direction(random), somewhere(), random() % 4 == 0 ? 0.0 : angle,
          random() % 2 == 0 ? 0.0 : test::uniform(random, -0.5, 0.5), test::pose(random, 3.0, 1.0)};
}

/// Two bodies, a ball of the second, and the true motion of its points in the first one's frame.
struct Case {
  Screw F, P;
  BoundingBall ball;

  Vector3d place(double s, const Vector3d& p) const { return F.pose(s).inverse() * (P.pose(s) * p); }

  double acceleration(const Vector3d& p) const {
    constexpr double kStep = 1e-3;
    double worst = 0.0;
    for (int k = 0; k <= 40; ++k) {
      const double s = kStep + (1.0 - 2.0 * kStep) * k / 40.0;
      const Vector3d second = place(s - kStep, p) - 2.0 * place(s, p) + place(s + kStep, p);
      worst = std::max(worst, second.norm() / (kStep * kStep));
    }
    return worst;
  }

  double travel(const Vector3d& p) const {
    double length = 0.0;
    for (int k = 0; k < 200; ++k) length += (place((k + 1) / 200.0, p) - place(k / 200.0, p)).norm();
    return length;
  }

  RelativeMotionBounds bounds() const {
    return relativeMotionBounds(worldTwist(ScrewMotion(F.pose(0.0), F.pose(1.0)), {}),
                                worldTwist(ScrewMotion(P.pose(0.0), P.pose(1.0)), ball));
  }
};

Case randomCase(Random& random) {
  const double most = random() % 3 == 0 ? 3.1 : 0.3;
  Case result{randomScrew(random, most), randomScrew(random, most), {}};
  if (random() % 4 == 0) {  // one arm carries both
    result.P.axis = result.F.axis;
    result.P.through = result.F.through;
    result.P.angle = result.F.angle;
    result.P.slide = result.F.slide;
  }
  result.ball = {test::direction(random), test::uniform(random, 0.0, 0.5)};
  return result;
}

/// Climbs to the point of the ball where `value` is greatest.
double worstInBall(Random& random, const BoundingBall& ball, const std::function<double(const Vector3d&)>& value) {
  Vector3d best = ball.center;
  double worst = value(best);
  for (int i = 0; i < 30; ++i) {
    const Vector3d tried = i < 10 ? Vector3d(ball.center + ball.radius * test::direction(random))
                                  : Vector3d(best + 0.2 * ball.radius * test::direction(random));
    const Vector3d out = tried - ball.center;
    const Vector3d p = out.norm() > ball.radius ? Vector3d(ball.center + ball.radius * out.normalized()) : tried;
    const double found = value(p);
    if (found <= worst) continue;
    worst = found;
    best = p;
  }
  return worst;
}

TEST(TwoBodyMotion, BoundsHoldAtTheWorstPointOfTheBall) {
  Random random(11);
  double tightest = 0.0, loosest = 1.0;
  for (int i = 0; i < 300; ++i) {
    const Case scene = randomCase(random);
    const RelativeMotionBounds bounds = scene.bounds();
    const double acceleration =
        worstInBall(random, scene.ball, [&](const Vector3d& p) { return scene.acceleration(p); });
    const double travel = worstInBall(random, scene.ball, [&](const Vector3d& p) { return scene.travel(p); });
    ASSERT_LE(acceleration, bounds.acceleration * (1.0 + 1e-4) + 1e-6) << i;
    ASSERT_LE(travel, bounds.travel + 1e-9) << i;
    tightest = std::max(tightest, travel / std::max(bounds.travel, 1e-9));
    loosest = std::min(loosest, (travel + 1e-9) / (bounds.travel + 1e-9));
  }
  EXPECT_GT(tightest, 0.95);
  EXPECT_GT(loosest, 0.05);
}

TEST(TwoBodyMotion, BodiesThatMoveAsOneDoNotMoveAgainstEachOther) {
  Random random(12);
  for (int i = 0; i < 100; ++i) {
    Case scene = randomCase(random);
    scene.P = scene.F;
    scene.P.X_WB = test::pose(random, 3.0, 1.0);
    EXPECT_LT(scene.bounds().travel, 1e-9);
    EXPECT_LT(scene.bounds().acceleration, 1e-8);
  }
}

TEST(TwoBodyMotion, WithOneBodyAtRestTheBoundsAreThoseOfItsScrew) {
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    Case scene = randomCase(random);
    scene.F = {Vector3d::UnitZ(), Vector3d::Zero(), 0.0, 0.0, test::pose(random, 3.0, 1.0)};
    const ScrewMotion screw(scene.P.pose(0.0), scene.P.pose(1.0));
    EXPECT_NEAR(scene.bounds().travel, screw.maxTravel(scene.ball), 1e-9);
    EXPECT_NEAR(scene.bounds().acceleration, screw.maxAcceleration(scene.ball), 1e-8);
  }
}

TEST(TwoBodyMotion, ChordsFollowBothBodies) {
  Random random(14);
  double worst_share = 0.0;
  for (int i = 0; i < 200; ++i) {
    const Case scene = randomCase(random);
    const ScrewMotion screw_F(scene.F.pose(0.0), scene.F.pose(1.0)), screw_P(scene.P.pose(0.0), scene.P.pose(1.0));
    ChordPath path;
    addChords({0.0, 2.0, screw_F, screw_P, scene.bounds().acceleration}, {1e-3, 10000}, 0, path);
    ASSERT_LE(path.error, 1e-3);
    for (int k = 0; k < 50; ++k) {
      const Chord& chord = path.chords[random() % path.chords.size()];
      const double s = test::uniform(random, 0.0, 1.0), time = chord.t_start + s * (chord.t_end - chord.t_start);
      const Vector3d p = scene.ball.center + scene.ball.radius * test::direction(random);
      const Vector3d on_chord = (1.0 - s) * (chord.X_FP_start * p) + s * (chord.X_FP_end * p);
      const double deviation = (on_chord - scene.place(0.5 * time, p)).norm();
      ASSERT_LE(deviation, path.error + 1e-9) << i;
      if (path.error > 1e-5) worst_share = std::max(worst_share, deviation / path.error);
    }
  }
  EXPECT_GT(worst_share, 0.8);
}

TEST(TwoBodyMotion, DisplacementBetweenPosesHolds) {
  Random random(15);
  for (int i = 0; i < 300; ++i) {
    const Isometry3d a = test::pose(random, 3.1, 1.0), b = a * test::pose(random, i % 2 == 0 ? 3.1 : 1e-3, 0.1);
    const BoundingBall ball{test::direction(random), test::uniform(random, 0.0, 1.0)};
    const double bound = maxDisplacement(a, b, ball);
    for (int k = 0; k < 50; ++k) {
      const Vector3d p = ball.center + ball.radius * test::direction(random);
      ASSERT_LE((a * p - b * p).norm(), bound + 1e-12);
    }
  }
}

TEST(ChainDerivatives, BoundTheThirdDifferencesOfRandomChains) {
  Random random(16);
  for (int i = 0; i < 300; ++i) {
    struct Joint {
      Isometry3d X;
      Vector3d axis;
      double angle, slide;
      bool forward;
    };
    std::vector<Joint> joints;
    const BoundingBall ball{test::direction(random), test::uniform(random, 0.0, 0.3)};
    ChainDerivatives bounds(ball);
    for (std::size_t n = 1 + random() % 7; joints.size() < n;) {
      const Joint joint{test::pose(random, 3.0, 0.5), test::direction(random), test::uniform(random, -1.0, 1.0),
                        random() % 3 == 0 ? test::uniform(random, -0.3, 0.3) : 0.0, random() % 4 != 0};
      const double reach = joint.X.translation().norm() + std::abs(joint.slide);
      joint.forward ? bounds.addFrame(reach, {std::abs(joint.angle)}, {std::abs(joint.slide)})
                    : bounds.addInverse(reach, {std::abs(joint.angle)}, {std::abs(joint.slide)});
      joints.push_back(joint);
    }
    const Vector3d p = ball.center + ball.radius * test::direction(random);
    const auto place = [&](double s) {
      Vector3d x = p;
      for (const Joint& joint : joints) {
        Isometry3d X = joint.X;
        X.translation() += s * joint.slide * joint.axis;
        X.linear() = Eigen::AngleAxisd(s * joint.angle, joint.axis) * joint.X.linear();
        x = joint.forward ? X * x : X.inverse() * x;
      }
      return x;
    };
    constexpr double kStep = 1e-2;
    for (double s = 2.0 * kStep; s < 1.0 - 2.0 * kStep; s += 0.05) {
      const Vector3d first = (place(s + kStep) - place(s - kStep)) / (2.0 * kStep);
      const Vector3d third =
          (place(s + 2.0 * kStep) - 2.0 * place(s + kStep) + 2.0 * place(s - kStep) - place(s - 2.0 * kStep)) /
          (2.0 * kStep * kStep * kStep);
      ASSERT_LE(place(s).norm(), bounds.distance() + 1e-9);
      ASSERT_LE(first.norm(), bounds.speed() * 1.001 + 1e-6);
      ASSERT_LE(third.norm(), bounds.jerk() * 1.001 + 1e-4);
    }
  }
}

TEST(ChainDerivatives, OneJointIsBoundedTightly) {
  ChainDerivatives bounds({Vector3d(1.0, 0.0, 0.0), 0.0});
  bounds.addFrame(0.0, {0.5}, {});
  EXPECT_DOUBLE_EQ(bounds.speed(), 0.5);
  EXPECT_DOUBLE_EQ(bounds.acceleration(), 0.25);
  EXPECT_DOUBLE_EQ(bounds.jerk(), 0.125);
}

/// A point of P in F's frame at any time, also of a part of the motion that starts and ends at poses of the whole,
/// against long double. What callers allow for (pose_rounding.h): 64 ε
/// of the distance from F's origin, and 16 ε of the coordinates of both origins and of the point for each body.
TEST(TwoBodyMotion, PosesAreOffByNoMoreThanTheirRounding) {
  constexpr double kEpsilon = std::numeric_limits<double>::epsilon();
  Random random(11);
  double worst = 0.0;
  for (int i = 0; i < 40000; ++i) {
    const double away = std::pow(10.0, test::uniform(random, -3.0, 5.0)),
                 most = std::pow(10.0, test::uniform(random, -9.0, 0.49));
    const double apart = std::pow(10.0, test::uniform(random, -3.0, 1.0));
    const Vector3d place = away * test::direction(random);
    const auto screw = [&] {
      Isometry3d start = test::pose(random, 3.0, apart);
      start.translation() += place;
      Isometry3d end = start;
      end.linear() = (Eigen::AngleAxisd(test::uniform(random, 0.0, most), test::direction(random)).toRotationMatrix() *
                      start.linear())
                         .eval();
      end.translation() += std::min(apart, most) * test::direction(random);
      return std::pair{start, end};
    };
    const auto [F_start, F_end] = screw();
    const auto [P_start, P_end] = screw();
    const ScrewMotion F(F_start, F_end), P(P_start, P_end);
    const test::LongScrew long_F(F_start, F_end), long_P(P_start, P_end);
    const Vector3d p = apart * test::direction(random);
    const double from = test::uniform(random, 0.0, 1.0), to = test::uniform(random, from, 1.0);
    const ScrewMotion part_F(F.pose(from), F.pose(to)), part_P(P.pose(from), P.pose(to));
    const double s = i % 7 == 0 ? 1.0 : test::uniform(random, 0.0, 1.0);
    const auto errorOf = [&](const ScrewMotion& of_f, const ScrewMotion& of_p, double at, test::Real time) {
      const TwoBodyMotion motion{0.0, 1.0, of_f, of_p, 0.0};
      const Vector3d p_F = motion.X_FP(at) * p;
      const test::LongPose X_WF = long_F.pose(time), X_WP = long_P.pose(time);
      const test::Vector3l exact = X_WF.R.transpose() * (X_WP * p.cast<test::Real>() - X_WF.p);
      const double size = F_start.translation().norm() + P_start.translation().norm() + p.norm();
      const double allowed = 64.0 * kEpsilon * p_F.norm() + 16.0 * kEpsilon * (size + p_F.norm());
      worst = std::max(worst, double((p_F.cast<test::Real>() - exact).norm()) / allowed);
    };
    errorOf(F, P, s, s);
    errorOf(part_F, part_P, s, test::Real(from) + test::Real(s) * (test::Real(to) - test::Real(from)));
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_GT(worst, 0.01);  // the margin is not a guess
}

}  // namespace sdf_ccd::two_body_motion_test
