#include "robot/proof_watch.h"

#include <gtest/gtest.h>

#include <random>

#include "motion/screw_motion.h"

namespace sdf_ccd::proof_watch_test {

BodyDescription body(const Primitive& shape, bool is_world) {
  BodyDescription made;
  made.is_world = is_world;
  made.geometry.emplace_back();
  made.geometry.back().shape = shape;
  return made;
}

Isometry3d at(double x, double y, double z = 0.0) {
  return Isometry3d(Eigen::Translation3d(x, y, z));
}

/// Two balls, the first of which is an object of the world.
class ProofWatchTest : public ::testing::Test {
 protected:
  bool isContradicted(const std::vector<Isometry3d>& X_WA, const std::vector<Isometry3d>& X_WB) {
    scene_.bodies = {body(object_, true), body(Sphere{kRadius}, false)};
    pairs_ = {{{object_ball_, {Vector3d::Zero(), kRadius}, {}, joined_}, 0, 1}};
    CycleMotion motion;
    for (std::size_t k = 0; k < X_WB.size(); ++k) motion.times.push_back(static_cast<double>(k));
    motion.X_WB = {X_WA, X_WB};
    motion.motion_error = {0.0, error_};
    return ProofWatch(pairs_, scene_).contradicted(motion, {{0, X_WB.size() - 1}})[0] != 0;
  }

  static constexpr double kRadius = 0.1;
  Primitive object_ = Sphere{kRadius};
  BoundingBall object_ball_{Vector3d::Zero(), kRadius};
  std::optional<Isometry3d> joined_;
  double error_ = 0.0;  // of the ball's motion [m]
  SceneDescription scene_;
  std::vector<UnreachablePair> pairs_;
};

TEST_F(ProofWatchTest, WhatComesWithinReachBetweenTwoPosesCounts) {
  const std::vector<Isometry3d> rests = {at(0, 0)};
  EXPECT_FALSE(isContradicted(rests, {at(-3, 0.201), at(3, 0.201)}));
  EXPECT_TRUE(isContradicted(rests, {at(-3, 0.199), at(3, 0.199)}));
  EXPECT_TRUE(isContradicted(rests, {at(-3, 0), at(0.199, 0)}));
  EXPECT_TRUE(isContradicted(rests, {at(0.199, 0), at(3, 1)})) << "just after the first";
  EXPECT_FALSE(isContradicted({at(-3, 5), at(3, 5)}, {at(-3, 0), at(3, 0)})) << "side by side";
}

TEST_F(ProofWatchTest, AWideObjectIsOutOfReachBesideItsBall) {
  object_ = Box{{5.0, 5.0, 0.1}};
  object_ball_.radius = 8.0;
  const std::vector<Isometry3d> rests = {at(0, 0)};
  EXPECT_FALSE(isContradicted(rests, {at(-3, 0, 0.201), at(3, 0, 0.201)}));
  EXPECT_TRUE(isContradicted(rests, {at(-3, 0, 0.199), at(3, 0, 0.199)}));
  EXPECT_TRUE(isContradicted(rests, {at(-3, 0, 1), at(3, 0, -1)})) << "through it";
  EXPECT_FALSE(isContradicted({at(0, 0, 0), at(0, 0, 9)}, {at(3, 0, 0.21), at(3, 0, 9.21)})) << "on it, in a lift";
}

/// Links of an arm that turns and bends, which only just do not reach each other.
TEST_F(ProofWatchTest, WhatMovesAsTheUrdfHasItIsNeverReported) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(-3.0, 3.0), turn(-0.6, 0.6), length(0.05, 1.0);
  for (int i = 0; i < 20000; ++i) {
    const double reach = 2.0 * kRadius, between = length(random);
    // The base turns about z, an elbow beside the object's centre about an axis in the base, the ball farther out.
    const double yaw = angle(random), bend = angle(random), yaw_turn = turn(random), bend_turn = turn(random);
    const auto base = [&](double s) {
      return at(2.0, 1.0) * Isometry3d(Eigen::AngleAxisd(yaw + s * yaw_turn, Vector3d::UnitZ())) * at(between, 0.0);
    };
    const auto ball = [&](double s) {
      return base(s) * Isometry3d(Eigen::AngleAxisd(bend + s * bend_turn, Vector3d(0.3, 1.0, 0.5).normalized())) *
             at(reach + 1e-5, 0.0);
    };
    std::vector<Isometry3d> X_WA, X_WB;
    const int steps = i % 3 == 0 ? 1 : 8;  // one joint in one step: the twist is its motion
    const double only = i % 3 == 0 ? 0.0 : 1.0;
    for (int k = 0; k <= steps; ++k) {
      const double s = static_cast<double>(k) / steps;
      X_WA.push_back(base(only * s));
      X_WB.push_back(only == 0.0 ? base(0.0) * base(s).inverse() * ball(s) : ball(s));
    }
    if (only == 0.0) X_WA.assign(1, base(0.0));
    error_ = 0.0;  // of the twists, which are in the middle
    for (int k = 1; k <= steps && only != 0.0; ++k) {
      const Isometry3d middle = ScrewMotion(X_WB[k - 1], X_WB[k]).pose(0.5);
      error_ = std::max(error_, 1.1 * (middle.translation() - ball((k - 0.5) / steps).translation()).norm());
    }
    EXPECT_FALSE(isContradicted(X_WA, X_WB)) << i;
  }
}

TEST_F(ProofWatchTest, JoinedBodiesMayDeviateByAMillimetreAtTheirFarthestPoints) {
  joined_ = at(1.0, 0.0);
  const auto turned = [&](double angle) {
    return at(1.0, 0.0) * Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitZ()));
  };
  const std::vector<Isometry3d> rests = {at(0, 0)};
  EXPECT_FALSE(isContradicted(rests, {at(1, 0), at(1.0009, 0)}));
  EXPECT_TRUE(isContradicted(rests, {at(1, 0), at(1.0011, 0)}));
  EXPECT_FALSE(isContradicted(rests, {at(1, 0), turned(0.009)})) << "0.9 mm at its surface";
  EXPECT_TRUE(isContradicted(rests, {at(1, 0), turned(0.011)}));
}

}  // namespace sdf_ccd::proof_watch_test
