// A single pair may take hours of work, so cancelling must also interrupt the check of a pair.
#include <gtest/gtest.h>

#include "cancel_moments.h"
#include "common/cancel_point.h"
#include "oracle/contact_case.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd::cancel_pair_test {

using namespace test;
constexpr int kMoments = 6;
constexpr double kSoon = 0.05;  // [s]

/// Checks a motion of the only pair.
void expectPairEndsSoon(const std::shared_ptr<const Scene>& scene, const CycleMotion& motion) {
  ASSERT_EQ(scene->pairs.size(), 1u);
  expectEndsSoon([&] { Monitor(scene, soft()).run(motion, {}); }, kMoments, kSoon);
}

/// A ball deep inside another one that rotates and shakes, in many chords.
CycleMotion shaken(double depth, std::size_t waypoints) {
  std::vector<Isometry3d> X_WB;
  for (std::size_t k = 0; k < waypoints; ++k) {
    Isometry3d X = Isometry3d::Identity();
    X.rotate(Eigen::AngleAxisd(2.5 * double(k % 2), Vector3d(1, 2, 3).normalized()));
    X.translation() = Vector3d(depth, 0.02 * double(k % 3), 0.0);
    X_WB.push_back(X);
  }
  return cycle(1.0, {still(Isometry3d::Identity(), waypoints), X_WB});
}

std::shared_ptr<const Scene> twoBalls() {
  return build({body("a", meshShape(icosphere(0.2, 4))), body("b", meshShape(icosphere(0.2, 4)))}, fine(0.008));
}

TEST(CancelPair, EndsSoonWhereItTouchesInManyPlaces) {
  expectPairEndsSoon(twoBalls(), shaken(0.3, 6));
}

TEST(CancelPair, EndsSoonWhereManyPointsStayInside) {
  expectPairEndsSoon(twoBalls(), shaken(0.05, 2));
}

TEST(CancelPair, EndsSoonWhereItIsNearAllTheTime) {
  expectPairEndsSoon(twoBalls(), shaken(0.4005, 30));
}

TEST(CancelPair, EndsSoonAtPrimitives) {
  expectPairEndsSoon(
      build({body("a", Box::fromSize({0.6, 0.6, 0.6})), body("b", meshShape(icosphere(0.2, 4)))}, fine(0.008)),
      shaken(0.2, 2));
}

TEST(CancelPair, EndsSoonAtOpenMeshes) {
  TriangleMesh bowl = icosphere(0.2, 4);
  bowl.triangles.resize(bowl.triangles.size() * 3 / 4);
  expectPairEndsSoon(build({body("a", meshShape(bowl)), body("b", meshShape(icosphere(0.2, 4)))}, fine(0.008)),
                     shaken(0.1, 2));
}

TEST(CancelPair, EndsSoonAfterItsDeadline) {
  const auto scene = twoBalls();
  const CycleMotion motion = shaken(0.3, 6);
  const double took = secondsOf([&] {
    const CancelScope deadline(CancelRequest::Clock::now() + std::chrono::milliseconds(50));
    EXPECT_THROW(Monitor(scene, soft()).run(motion, {}), Cancelled);
  });
  EXPECT_GE(took, 0.05);
  EXPECT_LT(took, 0.05 + kSoon * slowness());
}

/// In a cycle without a due pair, one that would be due soon is measured. The cycle's results are complete without it.
TEST(CancelPair, DoesNotEndACycleThatOnlyMeasures) {
  const auto scene = twoBalls();
  // How many cycles of an approach pass before the pair is due or, cancelled, ends one.
  const auto cyclesBefore = [&](bool cancelled, const CycleRequest& request) {
    const auto approach = [](int i) {
      constexpr double kStep = 1.0 / 8192.0;  // [m], so that cycles join without rounding
      const double x = 0.5 - kStep * i;
      return cycle(1e-3, {still(Isometry3d::Identity(), 2), {translation({x, 0, 0}), translation({x - kStep, 0, 0})}});
    };
    Monitor monitor(scene, soft());
    monitor.run(approach(0), request);
    const std::atomic<bool> flag{cancelled};
    const CancelScope scope(flag);
    int i = 1;
    try {
      const auto is_due = [&] {
        const CycleResult& result = monitor.run(approach(i), request);
        return result.checked + result.postponed > 0;
      };
      while (i < 1000 && !is_due()) ++i;
    } catch (const Cancelled&) {
    }
    return i;
  };
  CycleRequest no_time_to_measure;
  no_time_to_measure.max_time = 1e-9;
  const int until_due = cyclesBefore(false, no_time_to_measure);
  EXPECT_GT(until_due, 10);
  EXPECT_LT(until_due, 1000);
  EXPECT_EQ(cyclesBefore(true, {}), until_due);
}

}  // namespace sdf_ccd::cancel_pair_test
