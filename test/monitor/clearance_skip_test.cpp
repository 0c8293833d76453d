#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "oracle/random.h"
#include "oracle/scene_case.h"

namespace sdf_ccd::clearance_skip_test {

using namespace test;

/// Bodies that move randomly in a room, sometimes fast.
class Wanderers {
 public:
  Wanderers(int count, unsigned seed) : random_(seed) {
    for (int i = 0; i < count; ++i) X_.push_back(pose(random_, 3.0, 0.6));
  }

  CycleMotion next() {
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    std::vector<std::vector<Isometry3d>> poses;
    for (Isometry3d& X : X_) {
      const double speed = u(random_) > 0.8 ? 0.2 : 0.02;
      std::vector<Isometry3d> waypoints = {X};
      for (int k = 0; k < 2; ++k) {
        const Vector3d to_middle = -0.1 * X.translation();
        X = translation(speed * (Vector3d(u(random_), u(random_), u(random_)) + to_middle)) * X *
            pose(Vector3d::Zero(), speed * u(random_), Vector3d(u(random_), u(random_), 2.0));
        waypoints.push_back(X);
      }
      poses.push_back(waypoints);
    }
    return cycle(0.1, poses);
  }

 private:
  Random random_;
  std::vector<Isometry3d> X_;
};

std::vector<BodyDescription> mixedBodies() {
  return {body("box", Primitive(Box::fromSize({0.2, 0.1, 0.3}))), body("ball", Primitive(Sphere{0.08})),
          body("can", Primitive(Cylinder::fromRadiusAndLength(0.05, 0.2))),
          body("slab", Primitive(Box::fromSize({0.4, 0.4, 0.02})))};
}

TEST(ClearanceSkip, GivesTheVerdictsOfTesting) {
  const auto scene = build(mixedBodies(), fine(0.02));
  Monitor skipping(scene, {}), testing(scene, {});
  Wanderers wanderers(4, 1);
  int skipped = 0, near = 0;
  for (int i = 0; i < 800; ++i) {
    const CycleMotion motion = wanderers.next();
    testing.reset();
    const CycleResult &a = skipping.run(motion, {}), &b = testing.run(motion, {});
    ASSERT_EQ(b.skipped, 0);
    skipped += a.skipped;
    std::vector<int> not_clear;
    for (std::size_t p = 0; p < a.pairs.size(); ++p) {
      ASSERT_EQ(a.pairs[p].verdict, b.pairs[p].verdict) << "cycle " << i << ", pair " << p;
      if (b.pairs[p].verdict != Verdict::kClear) not_clear.push_back(static_cast<int>(p));
    }
    ASSERT_EQ(a.not_clear, not_clear) << "cycle " << i;
    ASSERT_EQ(b.not_clear, not_clear) << "cycle " << i;
    near += static_cast<int>(not_clear.size());
  }
  EXPECT_GT(skipped, 600);
  EXPECT_GT(near, 50);
}

TEST(ClearanceSkip, SkippedClearIsNeverWrong) {
  // Ball against box, where the distance is known; the reported clearance must hold too.
  const double radius = 0.08;
  const Primitive box = Box::fromSize({0.2, 0.1, 0.3});
  const auto scene = build({body("box", box), body("ball", Primitive(Sphere{radius}))}, fine(0.02));
  Monitor monitor(scene, {});
  int skipped = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    Wanderers wanderers(2, seed);  // a jump between the motions of two seeds, without reset()
    for (int i = 0; i < 100; ++i) {
      const CycleMotion motion = wanderers.next();
      const PairResult& pair = monitor.run(motion, {}).pairs[0];
      skipped += pair.skipped;
      if (pair.verdict != Verdict::kClear) continue;
      const auto distanceAt = [&](const Isometry3d& X_WA, const Isometry3d& X_WB) {
        return signedDistance(box, X_WA.inverse() * X_WB.translation()) - radius;
      };
      for (int k = 0; k < 2; ++k) {
        const ScrewMotion relative(motion.X_WB[0][k].inverse() * motion.X_WB[1][k],
                                   motion.X_WB[0][k + 1].inverse() * motion.X_WB[1][k + 1]);
        for (int s = 0; s <= 20; ++s) {
          ASSERT_GT(distanceAt(Isometry3d::Identity(), relative.pose(s / 20.0)), 0.0) << "seed " << seed;
        }
      }
      ASSERT_LE(pair.clearance, distanceAt(motion.X_WB[0].back(), motion.X_WB[1].back()) + 1e-12);
    }
  }
  EXPECT_GT(skipped, 500);
}

/// A clearance that was requested in one cycle must not remain as the result of later ones.
TEST(ClearanceSkip, ClearancesHoldWhetherOrNotTheyAreAskedFor) {
  constexpr double kHalf = 0.05;
  const auto scene = build({body("a", Primitive(Sphere{kHalf})), body("b", Primitive(Sphere{kHalf}))}, fine(0.02));
  Monitor monitor(scene, {});
  CycleRequest request;
  double x = 1.0;
  int skipped = 0;
  for (int i = 0; i < 8; ++i) {
    const double next = x - 0.1;
    request.skipped_pairs = i % 4 < 2;
    const PairResult& pair =
        monitor
            .run(cycle(0.1, {still(Isometry3d::Identity()), {translation({x, 0, 0}), translation({next, 0, 0})}}),
                 request)
            .pairs[0];
    EXPECT_EQ(pair.verdict, Verdict::kClear);
    EXPECT_LE(pair.clearance, next - 2.0 * kHalf + 1e-12) << i;
    skipped += pair.skipped;
    x = next;
  }
  EXPECT_GE(skipped, 6);
}

TEST(ClearanceSkip, LookingCloserIsPaidForOnlyWhenNear) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.02));
  Monitor monitor(scene, {});
  const auto at = [&](double from, double to) -> const PairResult& {
    return monitor
        .run(cycle(0.1, {still(Isometry3d::Identity()), {translation({0, 0, from}), translation({0, 0, to})}}), {})
        .pairs[0];
  };
  EXPECT_FALSE(at(1.0, 0.9).skipped);
  EXPECT_TRUE(at(0.9, 0.8).skipped);
  EXPECT_NEAR(at(0.8, 0.7).clearance, 0.6, 0.15);
  EXPECT_EQ(at(0.7, 0.1).verdict, Verdict::kUncertain);
  EXPECT_LT(at(0.1, 0.1).clearance, 0.0);
  // A motion that does not begin where the last one ended is not assumed to be near it.
  at(1.0, 0.9);
  EXPECT_EQ(at(0.09, 0.09).verdict, Verdict::kContact);
}

}  // namespace sdf_ccd::clearance_skip_test
