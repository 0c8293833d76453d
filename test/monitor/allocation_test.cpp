#include <gtest/gtest.h>

#include "allocations.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::allocation_test {

using namespace test;

TEST(Allocation, NoneWhilePairsAreClear) {
  const auto scene = build({body("ground", ground(), true), body("a", Primitive(Sphere{0.1})),
                            body("b", Primitive(Box::fromSize({0.2, 0.2, 0.2}))), body("c", Primitive(Sphere{0.1}))});
  Monitor monitor(scene, {});
  std::vector<CycleMotion> motions;
  for (int i = 0; i < 20; ++i) {
    // Two bodies nearer to the ground than they move, so that they are tested every time, and one far away.
    const double x = 0.001 * i;
    motions.push_back(cycle(0.1, {still(Isometry3d::Identity()),
                                  {translation({x, 0, 0.1003}), translation({x + 1e-3, 0, 0.1003})},
                                  {translation({-0.25 - x, 0, 0.1003}), translation({-0.251 - x, 0, 0.1003})},
                                  still(translation({0, 3, 5}))}));
  }
  int tested = 0;
  EXPECT_EQ(steadyAllocations([&] {
              for (const CycleMotion& motion : motions) {
                const CycleResult& result = monitor.run(motion, {});
                tested += result.checked;
                ASSERT_EQ(result.verdict, Verdict::kClear);
              }
            }),
            0);
  EXPECT_GT(tested, 20);
}

TEST(Allocation, NoneForAContactLikeTheLast) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1})),
                            body("box", Primitive(Box::fromSize({0.2, 0.2, 0.2})))});
  Monitor monitor(scene, {});
  const CycleMotion motion = cycle(0.1, {still(Isometry3d::Identity()),
                                         still(translation({0, 0, 0.095})),
                                         {translation({0.19, 0, 0.1}), translation({0.19, 0, 0.12})}});
  EXPECT_EQ(steadyAllocations([&] { ASSERT_EQ(monitor.run(motion, {true, 10}).verdict, Verdict::kContact); }), 0);
}

/// Between meshes, with the deepest point measured on triangles, while one turns and slides.
TEST(Allocation, NoneForARefinedContactLikeTheLast) {
  BodyOptions options = fine();
  const auto scene = build(
      {body("slab", meshShape(boxMesh({0.3, 0.3, 0.02}))), body("cube", meshShape(boxMesh({0.1, 0.1, 0.1})))}, options);
  Monitor monitor(scene, {});
  const CycleMotion motion = cycle(
      0.1,
      {still(Isometry3d::Identity()), {pose({0, 0, 0.119}, 0.1, {0, 1, 0}), pose({0.001, 0, 0.118}, 0.12, {0, 1, 0})}});
  CycleRequest request{true, 10};
  EXPECT_EQ(steadyAllocations([&] {
              const CycleResult& result = monitor.run(motion, request);
              ASSERT_TRUE(result.pairs[0].measured);
              ASSERT_GT(result.pairs[0].deepest.depth, 0.0);
            }),
            0);
}

/// Peak of the additional memory while a new monitor checks the motion [MB].
double peakOf(const std::shared_ptr<const Scene>& scene, const CycleMotion& motion) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const long before = held;
  most_held = before;
  Monitor(scene, {}).run(motion, {true, 20});
  return 1e-6 * static_cast<double>(most_held - before);
}

/// A ball pressed into the ground that rotates in place by half a radian per step.
CycleMotion rolling(std::size_t waypoints) {
  std::vector<Isometry3d> X_WB;
  for (std::size_t k = 0; k < waypoints; ++k) X_WB.push_back(pose({0, 0, 0.05}, 0.5 * double(k), {1, 0, 0}));
  return cycle(1.0, {still(Isometry3d::Identity(), waypoints), X_WB});
}

TEST(Allocation, DoesNotGrowWithHowLongPointsTouch) {
  const auto scene = build({body("ground", ground(), true), body("ball", Primitive(Sphere{0.1}))}, fine(0.004));
  const double few = peakOf(scene, rolling(3)), many = peakOf(scene, rolling(30));
  EXPECT_GT(few, 0.1);
  EXPECT_LT(many, 40.0) << few << " MB over two steps";
}

TEST(Allocation, DoesNotGrowWithTheNumberOfPairs) {
  const auto peak = [](int balls) {
    std::vector<BodyDescription> bodies = {body("ground", ground(), true)};
    for (int i = 0; i < balls; ++i) bodies.push_back(body("ball " + std::to_string(i), Primitive(Sphere{0.1})));
    CycleMotion motion = rolling(30);
    const std::vector<Isometry3d> first = motion.X_WB[1];
    for (int i = 1; i < balls; ++i) {
      motion.X_WB.push_back(first);
      for (Isometry3d& X : motion.X_WB.back()) X.translation().x() += i;
    }
    return peakOf(build(bodies, fine(0.004)), motion);
  };
  const double one = peak(1), six = peak(6);  // the six balls are far from each other
  EXPECT_LT(six, 1.5 * one) << one << " MB of one";
}

/// Two links among many objects: adopt() neither allocates nor frees.
TEST(Allocation, NoneWhileAChangeIsTakenOver) {
  SceneDescription description{
      {body("a", Primitive(Sphere{0.1})), body("b", Primitive(Box::fromSize({0.2, 0.2, 0.2})))}, {}};
  for (int i = 0; i < 300; ++i) {
    description.bodies.push_back(body("o" + std::to_string(i), Primitive(Sphere{0.05}), true));
    description.bodies.back().X_frame_B = translation({0.3 * i, 0, 0});
  }
  WorldEditor editor(fine(0.03));
  auto snapshot = editor.next(description);
  Monitor monitor(snapshot->scene, {});
  const auto motion = [&] {
    CycleMotion motion;
    motion.times = {0.0, 0.1};
    for (const BodyDescription& one : description.bodies)
      motion.X_WB.push_back(still(one.X_frame_B * translation({0, 0, one.is_world ? 0.0 : 0.3})));
    return motion;
  };
  const auto run = [&] { return monitor.run(motion(), {}).checked; };
  run();
  EXPECT_LT(run(), 40);
  description.bodies.erase(description.bodies.begin() + 40);
  description.bodies.push_back(body("new", Primitive(Sphere{0.05}), true));
  description.bodies.back().X_frame_B = translation({0, 5, 0});
  snapshot = editor.next(description);
  const CycleMotion likely = motion();
  const auto change = monitor.prepare(snapshot->scene, &likely);
  {
    const ThreadAllocations allocations;
    const long held_before = held;
    monitor.adopt(*change);
    EXPECT_EQ(allocations.count(), 0);
    EXPECT_EQ(held, held_before);
  }
  EXPECT_LT(run(), 40) << "what was known is not known any more";
}

}  // namespace sdf_ccd::allocation_test
