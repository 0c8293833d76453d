#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "monitor/clearance_table.h"
#include "motion/two_body_motion.h"
#include "oracle/random.h"

// Balls that move, for tests of the clearance table.

namespace sdf_ccd::test {

constexpr double kClearance = 64.0;  // [m]

/// Bodies that are balls, and most of their pairs.
inline Scene balls(int count, Random& random) {
  Scene scene;
  for (int i = 0; i < count; ++i) {
    Body body;
    body.name = std::to_string(i);
    body.ball = {uniform(random, 0.0, 0.3) * direction(random), uniform(random, 0.01, 0.3)};
    scene.bodies.push_back(body);
    for (int k = 0; k < i; ++k)
      if ((i + k) % 7 != 0) scene.pairs.push_back({k, i, true, true});
  }
  return scene;
}

/// How the bodies of a trial move.
struct Family {
  double angle, shift;  // largest per step [rad], [m]
  double apart;         // spread of the bodies [m]
  double away;          // distance from the origin [m]
  bool on_a_base;       // all of them move with a common base, apart from small motions
};

/// A random pose near X, as after a step.
inline Isometry3d moved(const Isometry3d& X, double angle, double shift, Random& random) {
  const Vector3d axis = direction(random), along = direction(random);
  Isometry3d next = X;
  next.linear() = Quaterniond(Eigen::AngleAxisd(uniform(random, 0.0, angle), axis) * Quaterniond(X.linear()))
                      .normalized()
                      .toRotationMatrix();
  next.translation() += uniform(random, 0.0, shift) * along;
  return next;
}

inline CycleMotion motionOf(const Family& family, int bodies, int steps, Random& random) {
  CycleMotion motion;
  for (int k = 0; k <= steps; ++k) motion.times.push_back(k);
  const Vector3d place = family.away * direction(random);
  std::vector<Isometry3d> base = {pose(random, 3.0, 0.0)};
  base.back().translation() = place;
  for (int k = 0; k < steps; ++k) base.push_back(moved(base.back(), family.angle, family.shift, random));
  for (int b = 0; b < bodies; ++b) {
    const bool rests = random() % 4 == 0;
    Isometry3d X = pose(random, 3.0, family.apart);
    std::vector<Isometry3d> X_WB;
    for (int k = 0; k <= steps; ++k) {
      Isometry3d placed = X;
      placed.translation() += place;
      X_WB.push_back(family.on_a_base ? base[std::size_t(k)] * X : placed);
      const double share = family.on_a_base ? 1e-3 : 1.0;
      if (!rests) X = moved(X, share * family.angle, share * family.shift, random);
    }
    motion.X_WB.push_back(X_WB);
  }
  return motion;
}

/// A motion of one second at rest in the other motion's first poses.
inline CycleMotion restAt(const CycleMotion& motion) {
  CycleMotion rest;
  rest.times = {0.0, 1.0};
  for (const auto& X_WB : motion.X_WB) rest.X_WB.push_back({X_WB.front(), X_WB.front()});
  return rest;
}

/// Upper bound of the displacement of P's ball's points relative to F in a step, from twists in double precision.
inline double travelOf(const WorldTwist& F, const WorldTwist& P) {
  const Vector3d u = P.velocity - F.velocityAt(P.center);
  return u.norm() + (P.omega - F.omega).norm() * (P.radius + 0.25 * P.speed());
}

/// The sum over all steps of the smaller bound of the two balls.
inline double boundOf(const Scene& scene, const PlannedPair& pair, const CycleMotion& motion) {
  double sum = 0.0;
  for (std::size_t k = 0; k + 1 < motion.times.size(); ++k) {
    const auto twist = [&](int body) {
      const auto& X_WB = motion.X_WB[std::size_t(body)];
      return worldTwist(ScrewMotion(X_WB[k], X_WB[k + 1]), scene.bodies[std::size_t(body)].ball);
    };
    const WorldTwist a = twist(pair.body_a), b = twist(pair.body_b);
    sum += std::min(travelOf(a, b), travelOf(b, a));
  }
  return sum;
}

}  // namespace sdf_ccd::test
