// A single pair may take hours of work, so cancelling must also interrupt the check of a pair.
#include <gtest/gtest.h>

#include "cancel_moments.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"

namespace sdf_ccd {
namespace {

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
  expectPairEndsSoon(build({body("a", Box{{0.3, 0.3, 0.3}}), body("b", meshShape(icosphere(0.2, 4)))}, fine(0.008)),
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

}  // namespace
}  // namespace sdf_ccd
