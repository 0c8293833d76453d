#include "sdf_ccd/distances.h"

#include <gtest/gtest.h>

#include <deque>
#include <memory>

#include "mesh/corners.h"
#include "monitor/pair_traits.h"
#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "oracle/triangle_distance.h"

namespace sdf_ccd::velocity_scale_test {

using test::direction;
using test::Random;
using test::uniform;

StoppingPromise anyPromise(Random& random) {
  StoppingPromise promise;
  promise.max_speed = uniform(random, 0.2, 3.0);
  promise.max_acceleration = uniform(random, 0.0, 20.0);
  promise.deceleration = uniform(random, 0.5, 10.0);
  promise.reaction_time = uniform(random, 0.0, 0.2);
  promise.period = uniform(random, 0.01, 0.2);
  promise.stop_distance = uniform(random, 0.0, 0.1);
  return promise;
}

/// Of one cycle alone.
ScaleLimit limitOf(const std::vector<PairDistance>& pairs, const std::vector<PairTraits>& traits, double age,
                   double oldest, const StoppingPromise& promise) {
  const ScaleLimits limits = velocityScales(pairs, traits, age, oldest, 1.0, promise);
  return limits.measured.scale < limits.promised.scale ? limits.measured : limits.promised;
}

/// A robot that just keeps its promise: it obeys as late and moves as fast as the promise allows.
class Robot {
 public:
  Robot(const StoppingPromise& promise, Random& random) : promise_(promise), random_(random) {}

  void hear(double time, double scale) {
    brakeAfterSilence(time);
    heard_.push_back({time + promise_.reaction_time, scale});
    last_ = time;
  }

  /// The speed after a step from `now`, as close to the wanted one as allowed.
  double next(double now, double step, double speed, double wanted) {
    brakeAfterSilence(now);
    while (!heard_.empty() && heard_.front().first <= now) {
      scale_ = heard_.front().second;
      heard_.pop_front();
    }
    const double limit = scale_ * promise_.max_speed;
    if (speed > limit) return std::max(limit, speed - promise_.deceleration * step);
    const double fastest = std::min(limit, speed + promise_.max_acceleration * step);
    return std::clamp(wanted, std::min(fastest, speed - 2.0 * promise_.deceleration * step), fastest);
  }

  Random& random() { return random_; }

 private:
  /// If no scale comes in time, it brakes as on a scale of 0.
  void brakeAfterSilence(double now) {
    if (now <= last_ + promise_.period || silent_since_ == last_) return;
    heard_.push_back({last_ + promise_.period + promise_.reaction_time, 0.0});
    silent_since_ = last_;
  }

  StoppingPromise promise_;
  Random& random_;
  std::deque<std::pair<double, double>> heard_;
  double scale_ = 0.0, last_ = -1e9, silent_since_ = -1e9;
};

struct Outcome {
  double least = 1e300, last = 0.0;  // widths minus the stop distance [m]
  double fastest = 0.0;
};

/// Closes a gap with a robot that moves as it likes within the scale.
Outcome close(const StoppingPromise& promise, Random& random, bool is_greedy) {
  constexpr double kStep = 1e-3, kLength = 12.0;
  Robot robot(promise, random);
  double width = promise.stop_distance + uniform(random, 0.01, 2.0), speed = 0.0, wanted = promise.max_speed;
  double next_scale = 0.0;
  std::vector<double> widths, speeds;
  Outcome outcome;
  for (int i = 0; i * kStep < kLength; ++i) {
    const double now = i * kStep;
    widths.push_back(width);
    speeds.push_back(speed);
    outcome.least = std::min(outcome.least, width - promise.stop_distance);
    outcome.fastest = std::max(outcome.fastest, speed);
    if (now >= next_scale) {
      // The data are somewhat old, and the speed is a mean over some time before.
      const int age = std::min(i, static_cast<int>(uniform(random, 0.0, 0.15) / kStep));
      const int over = std::min(i - age, 1 + static_cast<int>(uniform(random, 0.0, 0.05) / kStep));
      if (over > 0) {
        PairDistance pair;
        pair.any.width = widths[i - age];
        pair.any.over = over * kStep;
        pair.any.closing = (widths[i - age - over] - widths[i - age]) / pair.any.over;
        robot.hear(now, limitOf({pair}, {}, age * kStep, age * kStep, promise).scale);
      }
      // The next scale comes in time, or for a while none comes.
      next_scale = now + (uniform(random, 0.0, 1.0) < 0.02 ? 5.0 : 0.95) * promise.period;
    }
    if (!is_greedy && i % 50 == 0) wanted = uniform(random, -1.0, 1.0) * promise.max_speed;
    speed = robot.next(now, kStep, speed, wanted);
    width -= speed * kStep;
    outcome.last = width - promise.stop_distance;
  }
  return outcome;
}

TEST(VelocityScale, WhoObeysNeverComesNearerThanTheStopDistanceAndComesThatNear) {
  Random random(3);
  for (int i = 0; i < 400; ++i) {
    const StoppingPromise promise = anyPromise(random);
    const bool is_greedy = i % 2 == 0;
    const Outcome outcome = close(promise, random, is_greedy);
    // Tolerance for the simulation's steps: a speed holds for a whole step, and braking starts a step late.
    const double step = 2e-3 * promise.max_speed;
    EXPECT_GE(outcome.least, -step) << i;
    if (!is_greedy) continue;
    // The scale allows the distance that may be needed until the robot obeys, if it accelerates meanwhile.
    const double T = 0.15 + promise.reaction_time;
    const double fastest = std::min(promise.max_speed, promise.max_acceleration * (T + 0.025));
    const double near = fastest * T + fastest * fastest / (2.0 * promise.deceleration);
    EXPECT_LT(outcome.least, 1.01 * near + 0.01) << i;
  }
}

TEST(VelocityScale, WhatIsFarOrOpensIsNotSlowed) {
  StoppingPromise promise;
  promise.max_acceleration = 1.0;
  PairDistance pair;
  pair.any = {scaleRange(promise, promise.stop_distance), promise.max_speed, 0.0};
  EXPECT_EQ(limitOf({pair}, {}, promise.max_age, promise.max_age, promise).scale, 1.0);
  pair.any = {0.1, promise.max_speed, 0.01};
  EXPECT_LT(limitOf({pair}, {}, 0.0, 0.0, promise).scale, 0.2);
  pair.slab = ClosingGap{0.1, -0.5, 0.01};  // along it they separate
  EXPECT_GT(limitOf({pair}, {}, 0.0, 0.0, promise).scale, 0.25);
  EXPECT_EQ(limitOf({}, {}, 0.0, 0.0, promise).scale, 1.0);
  const double too_old = promise.max_age + 1e-3;
  EXPECT_EQ(limitOf({}, {}, 0.0, too_old, promise).scale, 0.0);      // some data are too old; no pair is near
  EXPECT_EQ(limitOf({pair}, {}, too_old, 0.0, promise).scale, 0.0);  // the pair's data are too old
  pair.any = *pair.slab = {0.0, 0.0, 0.01};
  EXPECT_EQ(limitOf({pair}, {}, 0.0, 0.0, promise).scale, 0.0);
}

TEST(VelocityScale, WhatIsIgnoredInAMapIsNotApproached) {
  StoppingPromise promise;
  promise.map_distance = 0.45;
  PairDistance pair;
  pair.any = {0.5, 0.0, 0.01};
  EXPECT_GT(limitOf({pair}, {}, 0.0, 0.0, promise).scale, 0.0);
  pair.is_with_map = true;
  EXPECT_EQ(limitOf({pair}, {}, 0.0, 0.0, promise).scale, 0.0);
  EXPECT_NEAR(scaleRange(promise, 0.0), 0.45 + scaleRange(StoppingPromise(), 0.0), 1e-12);
  EXPECT_NEAR(scaleRange(promise, 0.5), 0.5 + scaleRange(StoppingPromise(), 0.0), 1e-12);
}

std::vector<PairTraits> ofOneOwnPair() {
  PairTraits own;
  own.is_own = true;
  return {own};
}

PairDistance pairAt(double width, double closing = 0.0) {
  PairDistance pair;
  pair.pair = 0;
  pair.normal_W = Vector3d::UnitX();
  pair.any = {width, std::abs(closing), 0.01};
  pair.closing_speed = closing;
  return pair;
}

TEST(VelocityScale, OwnPairsLimitOnlyWhileTheyClose) {
  StoppingPromise promise;
  promise.stop_distance = 0.005;
  const std::vector<PairTraits> own = ofOneOwnPair();
  const auto scale = [&](const PairDistance& pair) { return limitOf({pair}, own, 0.02, 0.02, promise).scale; };
  EXPECT_EQ(limitOf({pairAt(0.022)}, {}, 0.02, 0.02, promise).scale, 0.0);  // of the world
  EXPECT_EQ(scale(pairAt(0.022)), 1.0);                                     // a wrist's gap
  EXPECT_EQ(scale(pairAt(0.022, -0.5)), 1.0);
  EXPECT_EQ(scale(pairAt(0.022, 0.03)), 1.0);  // it can stop from that
  EXPECT_LT(scale(pairAt(0.022, 0.5)), 0.1);
  EXPECT_GT(scale(pairAt(0.022, 0.5)), 0.05);
  EXPECT_EQ(scale(pairAt(0.005)), 0.0);
  EXPECT_EQ(scale(pairAt(0.004, -0.5)), 0.0);
  PairDistance unknown = pairAt(0.022);  // where the direction is not known, the fastest point counts
  unknown.normal_W.setZero();
  unknown.any.closing = 0.5;
  EXPECT_LT(scale(unknown), 0.1);
  const ScaleLimit limit = limitOf({pairAt(1.0), pairAt(0.022, 0.5)}, own, 0.02, 0.02, promise);
  ASSERT_TRUE(limit.pair);
  EXPECT_EQ(limit.pair->any.width, 0.022);
}

TEST(VelocityScale, OwnPairsCanCountByWhatTheyCanDo) {
  StoppingPromise promise;
  promise.own_pairs = OwnPairs::kPromise;
  std::vector<PairTraits> own = ofOneOwnPair();
  const auto scale = [&](double width) { return limitOf({pairAt(width)}, own, 0.0, 0.0, promise).scale; };
  EXPECT_EQ(scale(0.022), 0.0);
  EXPECT_EQ(scale(0.022), limitOf({pairAt(0.022)}, {}, 0.0, 0.0, promise).scale);
  own[0].max_closing = 0.05;  // its joints are slow
  EXPECT_EQ(scale(standstillDistance(promise, 0.0, 0.05) - 1e-6), 0.0);
  EXPECT_GT(scale(standstillDistance(promise, 0.0, 0.05) + 1e-4), 0.0);
  EXPECT_EQ(scale(0.022), 1.0);
}

TEST(VelocityScale, APairWhoseDistanceCannotChangeLimitsInNeitherRule) {
  StoppingPromise promise;
  promise.stop_distance = 0.03;
  for (const OwnPairs rule : {OwnPairs::kMeasured, OwnPairs::kPromise}) {
    promise.own_pairs = rule;
    std::vector<PairTraits> own = ofOneOwnPair();
    EXPECT_EQ(limitOf({pairAt(0.02)}, own, 0.0, 0.0, promise).scale, 0.0);
    own[0].is_constant = true;
    EXPECT_EQ(limitOf({pairAt(0.02)}, own, 0.0, 0.0, promise).scale, 1.0);
    EXPECT_EQ(limitOf({pairAt(0.0)}, own, 0.0, 0.0, promise).scale, 0.0);  // they touch
    PairDistance at_rest = pairAt(0.02);                                   // a table and the base that stands on it
    at_rest.is_constant = true;
    EXPECT_EQ(limitOf({at_rest}, {}, 0.0, 0.0, promise).scale, 1.0);
  }
}

TEST(VelocityScale, APairMayHaveItsOwnStopDistance) {
  StoppingPromise promise;
  promise.stop_distance = 0.05;
  std::vector<PairTraits> traits = ofOneOwnPair();
  EXPECT_EQ(limitOf({pairAt(0.02)}, traits, 0.0, 0.0, promise).scale, 0.0);
  traits[0].stop_distance = 0.005;
  EXPECT_EQ(limitOf({pairAt(0.02)}, traits, 0.0, 0.0, promise).scale, 1.0);
  traits[0] = {};
  traits[0].stop_distance = 0.4;
  EXPECT_EQ(limitOf({pairAt(0.45)}, traits, 0.0, 0.0, promise).scale, 0.0);
  EXPECT_GT(limitOf({pairAt(0.45)}, {}, 0.0, 0.0, promise).scale, 0.0);
  EXPECT_EQ(largestStopDistance(traits, 0.05), 0.4);
}

TEST(VelocityScale, WhatIsNotANumberIsOld) {
  const StoppingPromise promise;
  const double nan = std::nan("");
  EXPECT_EQ(limitOf({pairAt(10.0)}, {}, 0.0, 0.0, promise).scale, 1.0);
  EXPECT_EQ(limitOf({pairAt(10.0)}, {}, nan, 0.0, promise).scale, 0.0);
  EXPECT_EQ(limitOf({pairAt(10.0)}, {}, 0.0, nan, promise).scale, 0.0);
  EXPECT_EQ(limitOf({pairAt(nan)}, {}, 0.0, 0.0, promise).scale, 0.0);
  EXPECT_EQ(limitOf({pairAt(10.0, nan)}, {}, 0.0, 0.0, promise).scale, 0.0);
  PairDistance pair = pairAt(10.0);
  pair.time = nan;
  EXPECT_EQ(limitOf({pair}, {}, 0.0, 0.0, promise).scale, 0.0);
  EXPECT_EQ(limitOf({pair}, ofOneOwnPair(), 0.0, 0.0, promise).scale, 0.0);
}

/// A robot that rests beside a wall may move in the next cycle.
TEST(VelocityScale, WhatRestsInThisCycleIsNotFixed) {
  const auto scene = test::build({test::body("hand", Primitive(Sphere{0.1})),
                                  test::body("wall", Primitive(Box::fromSize({0.1, 1.0, 1.0})), true)});
  Monitor monitor(scene, test::soft());
  PairDistances distances(scene);
  CycleMotion motion;
  motion.times = {0.0, 0.1};
  motion.X_WB = {{test::translation({0.2, 0.0, 0.0})}, {Isometry3d::Identity()}};  // 5 cm apart
  const CycleResult& result = monitor.run(motion, {});
  const StoppingPromise promise;
  for (const bool is_fixed : {false, true}) {
    CycleRecord record;
    record.single_pose_is_fixed = is_fixed;
    const std::vector<PairDistance>& near = distances.update(motion, result, 1.0, record);
    ASSERT_EQ(near.size(), 1u);
    EXPECT_EQ(near[0].is_constant, is_fixed);
    EXPECT_EQ(limitOf(near, {}, 0.1, 0.1, promise).scale, is_fixed ? 1.0 : 0.0);
  }
}

/// Two links of a robot that a program closes at C, by the scale; its data are old, and it obeys late.
struct OwnClosing {
  double least = 1e300;  // width minus the stop distance [m]
  double swing = 0.0;    // largest rise of the scale in the last second
};

OwnClosing closeOwnPair(const StoppingPromise& promise, double at_scale_one, double age, Random& random) {
  constexpr double kStep = 1e-3, kLength = 20.0;
  double width = promise.stop_distance + 2.0, speed = 0.0, scale = 1.0, next_scale = 0.0, before = 1.0;
  std::deque<std::pair<double, double>> heard;
  std::vector<double> widths;
  PublishedScales scales;
  OwnClosing outcome;
  const int old = static_cast<int>(age / kStep);
  for (int i = 0; i * kStep < kLength; ++i) {
    const double now = i * kStep;
    widths.push_back(width);
    if (now >= next_scale && i >= old + 10) {
      const double closing = (widths[i - old - 10] - widths[i - old]) / (10 * kStep);
      const std::vector<PairDistance> near = {pairAt(widths[i - old], closing)};
      const ScaleLimits limits = velocityScales(near, ofOneOwnPair(), age, age, scales.obeyed(now, promise), promise);
      const double told = scales.limitRise(limits.measured, now, promise).scale;
      scales.add(told, now, promise);
      heard.push_back({now + uniform(random, 0.0, 1.0) * promise.reaction_time, told});
      if (now > kLength - 1.0) outcome.swing = std::max(outcome.swing, told - before);
      before = told;
      next_scale = now + 0.5 * promise.period;
    }
    while (!heard.empty() && heard.front().first <= now) {
      scale = heard.front().second;
      heard.pop_front();
    }
    const double wanted = scale * at_scale_one;
    speed = std::clamp(wanted, speed - promise.deceleration * kStep, speed + promise.max_acceleration * kStep);
    width -= speed * kStep;
    outcome.least = std::min(outcome.least, width - promise.stop_distance);
  }
  return outcome;
}

TEST(VelocityScale, AnOwnPairThatAProgramClosesComesToRestBeforeItsStopDistance) {
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    StoppingPromise promise;
    promise.stop_distance = 0.01;
    promise.max_speed = uniform(random, 0.3, 2.0);
    promise.reaction_time = uniform(random, 0.0, 0.2);
    promise.deceleration = uniform(random, 1.0, 6.0);
    const double share = i % 2 == 0 ? 1.0 : uniform(random, 0.2, 1.0);
    const OwnClosing outcome = closeOwnPair(promise, share * promise.max_speed, uniform(random, 0.0, 0.15), random);
    EXPECT_GT(outcome.least, -1e-3 * promise.max_speed) << i;  // a step of the simulation
    EXPECT_LT(outcome.least, 0.2) << i;                        // it comes near nevertheless
    EXPECT_LT(outcome.swing, 0.02) << i;                       // and does not flutter
  }
}

/// Exact distance of two meshes at their poses, over all pairs of triangles.
double trueDistance(const TriangleMesh& a, const Isometry3d& X_WA, const TriangleMesh& b, const Isometry3d& X_WB) {
  const auto placed = [](const TriangleMesh& mesh, const Isometry3d& X) {
    std::vector<test::Triangle3r> all;
    for (int i = 0; i < int(mesh.triangles.size()); ++i) {
      const Corners corners = cornersOf(mesh, i);
      all.push_back({});
      for (int k = 0; k < 3; ++k) all.back()[k] = (X * corners[k]).cast<test::Real>();
    }
    return all;
  };
  test::Real least = 1e300L;
  const auto in_a = placed(a, X_WA), in_b = placed(b, X_WB);
  for (const auto& t : in_a)
    for (const auto& u : in_b) least = std::min(least, test::triangleDistance(t, u));
  return static_cast<double>(least);
}

/// A body moves randomly among others, and towards them, as a robot that obeys; the truth are distances of the meshes.
TEST(VelocityScale, ABodyThatObeysNeverTouchesAnyOther) {
  Random random(11);
  double nearest = 1e300;
  for (int run = 0; run < 3; ++run) {
    StoppingPromise promise;
    promise.max_speed = 1.0;
    promise.max_acceleration = 8.0;
    promise.deceleration = 4.0;
    promise.reaction_time = 0.03;
    promise.period = 0.05;
    promise.stop_distance = 0.005;
    const TriangleMesh flyer = test::icosphere(0.08, 0), block = test::boxMesh({0.05, 0.3, 0.2});
    const auto scene =
        test::build({test::body("flyer", test::meshShape(flyer)), test::body("block", test::meshShape(block), true),
                     test::body("ball", Primitive(Sphere{0.1}), true), test::body("ground", test::ground(), true)},
                    test::fine(0.01));
    const Isometry3d X_block = test::translation({0.4, 0.0, 0.3}), X_ball = test::translation({-0.3, 0.2, 0.3});
    Monitor monitor(scene, test::soft());
    PairDistances distances(scene);
    Robot robot(promise, random);
    constexpr double kStep = 5e-3;
    Isometry3d X = test::translation({0.0, 0.0, 0.4});
    Vector3d way = direction(random), spin = direction(random);
    double speed = 0.0, known = 0.0;
    std::vector<Isometry3d> poses = {X};
    for (int i = 1; i < 800; ++i) {
      const double now = i * kStep;
      if (i % 40 == 0 && speed == 0.0) {
        // From rest it takes a new direction: the promise is about the speed of any point, so the direction is free.
        const Vector3d aim =
            i % 80 == 0 ? Vector3d(X_block.translation() - X.translation()).normalized() : Vector3d(direction(random));
        way = aim;
        spin = 2.0 * direction(random);
      }
      // The speed is that of the ball's fastest point: 1 + |spin| r times that of the centre.
      const double reach = 1.0 + spin.norm() * 0.08;
      const double wanted = (X.translation() - Vector3d(0, 0, 0.3)).norm() > 1.0 ? 0.0 : promise.max_speed;
      if (wanted == 0.0) way = -X.translation().normalized();
      speed = robot.next(now, kStep, speed, wanted);
      X.translation() += speed / reach * kStep * way;
      X.linear() = Eigen::AngleAxisd(speed / reach * spin.norm() * kStep, spin.normalized()) * X.linear();
      poses.push_back(X);
      TriangleMesh point;  // the ball's centre
      point.vertices = {Vector3d::Zero(), Vector3d::Zero(), Vector3d::Zero()};
      point.triangles = {{0, 1, 2}};
      nearest =
          std::min({nearest, trueDistance(flyer, X, block, X_block), trueDistance(flyer, X, point, X_ball) - 0.1});
      for (const Vector3d& p : flyer.vertices) nearest = std::min(nearest, (X * p).z());
      ASSERT_GE(nearest, promise.stop_distance - 0.001) << run << " " << i;
      if (i % 8 != 0) continue;
      CycleMotion motion;
      motion.X_WB.resize(4);
      for (std::size_t k = 0; k < poses.size(); ++k) {
        motion.times.push_back(kStep * double(k));
        motion.X_WB[0].push_back(poses[k]);
        motion.X_WB[1].push_back(X_block);
        motion.X_WB[2].push_back(X_ball);
        motion.X_WB[3].push_back(Isometry3d::Identity());
      }
      const CycleResult& result = monitor.run(motion, {false, 0});
      ASSERT_EQ(result.verdict, Verdict::kClear);
      const std::chrono::nanoseconds origin(std::llround(1e9 * (now - motion.times.back())));
      const double range = scaleRange(promise, promise.stop_distance);
      const std::vector<PairDistance>& near = distances.update(motion, result, range, {origin});
      robot.hear(now, limitOf(near, {}, motion.times.back(), 0.0, promise).scale);
      poses = {X};
      known = now;
    }
    EXPECT_GT(known, 0.0);
  }
  EXPECT_LT(nearest, 0.05);  // it comes near nevertheless
}

}  // namespace sdf_ccd::velocity_scale_test
