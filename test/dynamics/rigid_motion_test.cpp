#include "dynamics/rigid_motion.h"

#include <gtest/gtest.h>

#include "oracle/bodies.h"
#include "oracle/failure.h"
#include "oracle/random.h"

namespace sdf_ccd::rigid_motion_test {

using namespace test;

const Matrix3d kUneven = Vector3d(1.0, 2.0, 2.5).asDiagonal();

TEST(RigidMotion, FreeTurnsKeepEnergyAndAngularMomentum) {
  Random random(5);
  for (const double turn : {1e-6, 0.3, 20.0, 3000.0}) {
    Matrix3d R = Matrix3d::Identity();
    Vector3d spin = direction(random) * turn;
    const Vector3d L = kUneven * spin;
    const double energy = spin.dot(L);
    for (int i = 0; i < 20; ++i) rotateFreely(kUneven, 1.0, R, spin);
    EXPECT_NEAR(spin.dot(kUneven * spin), energy, 1e-10 * energy) << turn;
    EXPECT_LT((R * (kUneven * spin) - L).norm(), 1e-10 * L.norm()) << turn;
  }
}

TEST(RigidMotion, SpinAboutAPrincipalAxisIsExact) {
  Matrix3d R = Matrix3d::Identity();
  Vector3d spin(0, 0, 7.0);
  rotateFreely(kUneven, 2.0, R, spin);
  EXPECT_LT((R - Eigen::AngleAxisd(14.0, Vector3d::UnitZ()).toRotationMatrix()).norm(), 1e-12);
  EXPECT_EQ(spin, Vector3d(0, 0, 7.0));
}

/// Angle between two rotations [rad].
double angleBetween(const Matrix3d& R, const Matrix3d& S) {
  return Eigen::AngleAxisd(R.transpose() * S).angle();
}

TEST(RigidMotion, SpinNearAPrincipalAxisIsNearlyExact) {
  // A tilt of 1e-13 about the axes of the least and of the greatest moment stays as small.
  for (const int k : {0, 2}) {
    const Vector3d axis = Vector3d::Unit(k);
    Matrix3d R = Matrix3d::Identity();
    Vector3d spin = 1000.0 * axis + Vector3d::Constant(1e-10);
    rotateFreely(kUneven, 1.0, R, spin);
    EXPECT_LT(angleBetween(R, Eigen::AngleAxisd(1000.0, axis).toRotationMatrix()), 1e-9);
  }
}

TEST(RigidMotion, DiscRotatesByItsClosedForm) {
  // I = (A, A, C): about L at |L| / A, after a rotation about its own axis at (1 − C / A) ω₃.
  for (const double C : {0.02, 0.9, 2.0}) {
    const Matrix3d disc = Vector3d(1.0, 1.0, C).asDiagonal();
    for (const Vector3d& start : {Vector3d(0.3, 0.0, 4.0), Vector3d(2.0, 2.0, 2.0), Vector3d(4.0, 0.1, -0.2)}) {
      Matrix3d R = Matrix3d::Identity();
      Vector3d spin = start;
      const Vector3d L = disc * spin;
      const double T = 25.0;
      const Matrix3d expected = (Eigen::AngleAxisd(L.norm() * T, L.normalized()) *
                                 Eigen::AngleAxisd((1.0 - C) * start.z() * T, Vector3d::UnitZ()))
                                    .toRotationMatrix();
      rotateFreely(disc, T, R, spin);
      EXPECT_LT(angleBetween(R, expected), 5e-5) << C << " " << start.transpose();
    }
  }
}

TEST(RigidMotion, FastSpinsAreCutSoThatNoPieceTurnsMoreThanARadian) {
  RigidWorld world;
  world.bodies = {pointBody("point", 1.0)};
  std::vector<BodyState> states = {at(Vector3d::Zero(), Vector3d::Zero(), {0, 0, 10.5})};
  StepMotion motion;
  drift(world, {Vector3d(3, 0, 0)}, 1.0, 1, states, motion);
  ASSERT_EQ(motion.times.size(), 12u);
  EXPECT_EQ(motion.times.back(), 1.0);
  EXPECT_LT((motion.X_OB[0].back().translation() - Vector3d(3, 0, 0)).norm(), 1e-15);
}

TEST(RigidMotion, WhatCannotBeComputedNamesBodyStepAndReason) {
  RigidWorld world;
  world.bodies = {pointBody("runaway", 1.0)};
  StepMotion motion;
  const auto messageOf = [&](const Vector3d& velocity, const Vector3d& spin) {
    std::vector<BodyState> states = {at(Vector3d::Zero(), velocity, spin)};
    return failureOf<SimulationError>([&] { drift(world, {velocity}, 1.0, 42, states, motion); });
  };
  EXPECT_NE(messageOf({1e10, 0, 0}, Vector3d::Zero())
                .find("body `runaway`, step 42: it would move 1e+10 m in one step, at most 1e+09 m"),
            std::string::npos);
  EXPECT_NE(messageOf(Vector3d::Zero(), {2e4, 0, 0}).find("rotate 20000 rad in one step, at most 10000 rad"),
            std::string::npos);
  EXPECT_NE(messageOf({std::nan(""), 0, 0}, Vector3d::Zero()).find("no longer finite"), std::string::npos);
}

}  // namespace sdf_ccd::rigid_motion_test
