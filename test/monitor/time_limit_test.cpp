// CycleRequest::max_time within the search and the integral of one pair. Expected depths: of balls.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <tbb/task_arena.h>

#include "common/processor_time.h"
#include "oracle/busy_machine.h"
#include "oracle/scene_case.h"
#include "oracle/shapes.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::time_limit_test {

using namespace test;

constexpr double kLimit = 0.002, kBeyond = 0.001;  // [s]

/// A ball that rotates and shakes beside or in another one, in many chords: takes some hundred limits.
CycleMotion shaken(double distance, std::size_t waypoints) {
  std::vector<Isometry3d> X_WB;
  for (std::size_t k = 0; k < waypoints; ++k) {
    Isometry3d X = translation({distance, 0.0, 0.0});
    X.rotate(Eigen::AngleAxisd(2.5 * double(k % 2), Vector3d(1, 2, 3).normalized()));
    X_WB.push_back(X);
  }
  return cycle(1.0, {still(Isometry3d::Identity(), waypoints), X_WB});
}

/// The first has a bead on its far side, so that the ball around it says little.
std::shared_ptr<const Scene> twoBalls(double spacing) {
  BodyDescription a = body("a", meshShape(icosphere(0.2, 4)));
  a.geometry.push_back({Primitive(Sphere{0.01}), translation({-0.4, 0.0, 0.0}), "bead"});
  return build({a, body("b", meshShape(icosphere(0.2, 4)))}, fine(spacing));
}

CycleRequest limited(double seconds = kLimit) {
  CycleRequest request;
  request.max_time = seconds;
  request.max_points = 20;
  return request;
}

/// The least of `runs`: processor time of a cycle that is the first of a monitor, on one thread [s].
double secondsOfCycle(const std::shared_ptr<const Scene>& scene, const CycleMotion& motion, const CycleRequest& request,
                      PairResult& result, int runs = 5) {
  double least = 1e9;
  tbb::task_arena arena(1);
  for (int i = 0; i < runs; ++i) {
    Monitor monitor(scene, soft());
    arena.execute([&] {
      const double start = threadSeconds();
      const CycleResult& cycle = monitor.run(motion, request);
      least = std::min(least, threadSeconds() - start);
      result = cycle.pairs[0];
    });
  }
  return least;
}

TEST(TimeLimit, HoldsWithinTheIntegralOfAContact) {
  const auto scene = twoBalls(0.008);
  const CycleMotion motion = shaken(0.3, 6);
  PairResult whole, cut;
  EXPECT_GT(secondsOfCycle(scene, motion, {}, whole, 1), 10.0 * kLimit);
  EXPECT_LT(secondsOfCycle(scene, motion, limited(), cut), kLimit + kBeyond);
  EXPECT_EQ(whole.verdict, Verdict::kContact);
  EXPECT_FALSE(whole.incomplete);
  EXPECT_GT(whole.on_a_W.force.norm(), 0.0);

  // What was proved stays proved. What is not known does not look known.
  EXPECT_EQ(cut.verdict, Verdict::kContact);
  EXPECT_TRUE(cut.incomplete);
  EXPECT_FALSE(cut.reason.empty());
  EXPECT_TRUE(cut.on_a_W.force.hasNaN() && cut.on_b_W.torque.hasNaN());
  ASSERT_EQ(cut.intervals.size(), 1u);
  EXPECT_EQ(cut.intervals[0].enter, 0.0);
  EXPECT_EQ(cut.intervals[0].exit, 1.0);
  EXPECT_TRUE(cut.points.empty());
  const double overlap = 0.1;  // of the balls: points of one are that deep in the other
  EXPECT_GE(cut.deepest.depth + cut.deepest.depth_error, overlap);
  EXPECT_LE(cut.deepest.depth, overlap);
  EXPECT_LE(cut.deepest.depth_error, 0.5);
}

TEST(TimeLimit, HoldsWithinASearchThatProvesNothing) {
  const auto scene = twoBalls(0.01);
  const CycleMotion motion = shaken(0.4001, 40);
  PairResult whole, cut;
  CycleRequest request = limited();
  request.wrenches = request.contacts = false;
  request.max_points = 0;
  CycleRequest unlimited = request;
  unlimited.max_time = 0.0;
  EXPECT_GT(secondsOfCycle(scene, motion, unlimited, whole, 1), 10.0 * kLimit);
  EXPECT_LT(secondsOfCycle(scene, motion, request, cut), kLimit + kBeyond);
  EXPECT_EQ(cut.verdict, Verdict::kUncertain);
  EXPECT_TRUE(cut.postponed);
  EXPECT_GE(cut.error.total(), 0.0);
}

TEST(TimeLimit, HoldsAboveAHalfSpace) {
  const auto scene = build({body("ground", ground(), true), body("ball", meshShape(icosphere(0.2, 4)))}, fine(0.004));
  CycleMotion motion = shaken(0.0, 20);
  for (Isometry3d& X : motion.X_WB[1]) X.translation() = Vector3d(0, 0, 0.195);
  PairResult whole, cut;
  EXPECT_GT(secondsOfCycle(scene, motion, {}, whole, 1), 10.0 * kLimit);
  EXPECT_LT(secondsOfCycle(scene, motion, limited(), cut), kLimit + kBeyond);
  EXPECT_EQ(whole.verdict, Verdict::kContact);
  EXPECT_TRUE(cut.verdict == Verdict::kContact ? cut.incomplete : cut.postponed) << toString(cut.verdict);
  if (cut.incomplete) {
    EXPECT_GE(cut.deepest.depth + cut.deepest.depth_error, 0.005);
  }
}

/// A wheel of beads around a ball that takes a hundred limits: their verdicts are found in most cycles all the same,
/// also while the ball's is never found.
TEST(TimeLimit, APairThatNeverEndsHoldsUpNoOthers) {
  for (const double distance : {0.3, 0.4001}) {
    std::vector<BodyDescription> bodies = {body("a", meshShape(icosphere(0.2, 4))),
                                           body("b", meshShape(icosphere(0.2, 4)))};
    for (int i = 0; i < 6; ++i) bodies.push_back(body("bead" + std::to_string(i), Primitive(Sphere{0.02})));
    const auto scene = build(bodies, fine(0.008));
    CycleMotion motion = shaken(distance, 40);
    for (int i = 0; i < 6; ++i)  // in pairs that touch
      motion.X_WB.push_back(still(translation({2.0 + 0.2 * (i / 2), 0.03 * (i % 2), 0.0}), 40));
    Monitor monitor(scene, soft());
    int cycles = 0, beads = 0, contacts = 0;
    for (int i = 0; i < 40; ++i) {
      const CycleResult& result = monitor.run(motion, limited(0.01));
      for (const PairResult& pair : result.pairs) {
        const bool are_beads = pair.body_a >= 2 && pair.verdict != Verdict::kClear;
        beads += are_beads && pair.verdict == Verdict::kContact;
        contacts += pair.body_b < 2 && pair.verdict == Verdict::kContact;
        EXPECT_FALSE(pair.body_b < 2 && pair.verdict == Verdict::kClear && distance < 0.4);
      }
      ++cycles;
    }
    // Nine tenths on an idle machine; what others take of the time is lost, too.
    EXPECT_GT(beads * slowness(), 2 * cycles) << distance << ", of " << 3 * cycles;
    if (distance < 0.4) {
      EXPECT_GT(contacts * slowness(), 2 * cycles / 3);
    }
  }
}

TEST(TimeLimit, AContactThatIsIncompleteForACycleIsTheSameContact) {
  const auto scene = twoBalls(0.008);
  const CycleMotion motion = shaken(0.3, 6);
  Monitor monitor(scene, soft());
  ContactTracker tracker(*scene);
  using Time = std::chrono::nanoseconds;
  std::uint64_t id = 0;
  for (int i = 0; i < 6; ++i) {
    const CycleResult& result = monitor.run(motion, i % 2 ? limited() : CycleRequest());
    EXPECT_EQ(result.incomplete, i % 2);
    tracker.update({result, motion, motion.times, Time(std::int64_t(1e9) * i)});
    ASSERT_EQ(tracker.size(), 1u) << i;
    if (i == 0) id = tracker[0].id;
    EXPECT_EQ(tracker[0].id, id);
    EXPECT_EQ(std::isnan(tracker[0].max_force), i > 0) << i;
  }
}

}  // namespace sdf_ccd::time_limit_test
