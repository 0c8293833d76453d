#include <gtest/gtest.h>

#include <cmath>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::crossing_intervals_test {

using namespace test;

/// Two rods of which each crosses an edge of the other, in most places between the points of both shells.
class CrossedRods : public ::testing::Test {
 protected:
  static constexpr double kHalf = 0.01, kOverlap = 1e-3;

  /// @param cells  of the fields; points are centimetres apart.
  static std::shared_ptr<const Scene> rods(int cells = 16) {
    const Primitive rod = Box::fromSize({0.4, 2.0 * kHalf, 2.0 * kHalf});
    BodyOptions options = fine(0.02);
    options.field.cells = cells;
    return build({body("rod", rod), body("other", rod)}, options);
  }

  /// Pose of the other rod: the crossing is at x and y on the first one.
  static Isometry3d across(double overlap, double x = -0.0407, double y = 0.0123) {
    return translation({x, y, 2.0 * std::sqrt(2.0) * kHalf - overlap}) * pose({0, 0, 0}, kPi / 2, {0, 0, 1}) * kTurned;
  }

  /// @param poses  of the other rod during a cycle of 0.1 s.
  static PairResult run(Monitor& monitor, const std::vector<Isometry3d>& poses) {
    return monitor.run(cycle(0.1, {still(kTurned, poses.size()), poses}), {}).pairs[0];
  }

  static inline const Isometry3d kTurned = pose({0, 0, 0}, kPi / 4, {1, 0, 0});  // one edge on top, one below
};

TEST_F(CrossedRods, BetweenPointsTheyAreAsDeepAsAtThem) {
  Monitor monitor(rods(64), soft());
  for (int i = 0; i < 20; ++i) {
    const Isometry3d there = across(kOverlap, -0.05 + 0.0037 * i, 0.0023 * i);
    monitor.reset();
    const PairResult pair = run(monitor, {there, there});
    ASSERT_EQ(pair.verdict, Verdict::kContact);
    EXPECT_LE(std::abs(pair.deepest.depth - kOverlap / std::sqrt(2.0)), pair.deepest.depth_error) << i;
    EXPECT_LT(pair.deepest.depth_error, 1e-4) << i;
  }
}

/// No shell point is inside, and they part halfway through the third cycle: one contact from the first cycle's begin
/// to then.
TEST_F(CrossedRods, AContactLastsAsLongAsTheSurfacesCross) {
  Monitor monitor(rods(), soft());
  const auto between = [&](double from, double to) { return run(monitor, {across(from), across(to)}); };
  for (int i = 0; i < 2; ++i) {
    const PairResult lasts = between(kOverlap, kOverlap);
    ASSERT_EQ(lasts.verdict, Verdict::kContact);
    EXPECT_NEAR(lasts.deepest.depth, kOverlap / std::sqrt(2.0), lasts.deepest.depth_error);
    ASSERT_EQ(lasts.intervals.size(), 1u);
    EXPECT_EQ(lasts.intervals[0].enter, 0.0);
    EXPECT_EQ(lasts.intervals[0].exit, 0.1);
  }
  const PairResult ends = between(kOverlap, -kOverlap);
  ASSERT_EQ(ends.verdict, Verdict::kContact);
  ASSERT_EQ(ends.intervals.size(), 1u);
  EXPECT_EQ(ends.intervals[0].enter, 0.0);
  EXPECT_NEAR(ends.intervals[0].exit, 0.05, 0.005);  // 0.1 mm of motion
  EXPECT_EQ(between(-kOverlap, -kOverlap).verdict, Verdict::kClear);
  const PairResult begins = between(-kOverlap, kOverlap);
  ASSERT_EQ(begins.intervals.size(), 1u);
  EXPECT_NEAR(begins.intervals[0].enter, 0.05, 0.005);
  EXPECT_EQ(begins.intervals[0].exit, 0.1);
}

/// They slide along each other, so that a shell point dips in now and then. The surfaces cross all the time.
TEST_F(CrossedRods, AContactLastsWhetherPointsFeelItOrNot) {
  Monitor monitor(rods(), soft());
  const auto at = [&](int step) { return across(kOverlap, -0.0407, -0.05 + 0.0025 * step); };
  for (int i = 0; i < 40; ++i) {
    const PairResult pair = run(monitor, {at(i), at(i + 1)});
    ASSERT_EQ(pair.verdict, Verdict::kContact);
    ASSERT_EQ(pair.intervals.size(), 1u) << i;
    EXPECT_EQ(pair.intervals[0].enter, 0.0) << i;
    EXPECT_EQ(pair.intervals[0].exit, 0.1) << i;
  }
}

/// The same in a single cycle, in which many points dip in, one after the other.
TEST_F(CrossedRods, AContactLastsThoughManyPointsFeelItInTurn) {
  Monitor monitor(rods(), soft());
  const PairResult pair = run(monitor, {across(kOverlap, -0.0407, -0.19), across(kOverlap, -0.0407, 0.19)});
  ASSERT_EQ(pair.verdict, Verdict::kContact);
  EXPECT_NEAR(pair.deepest.depth, kOverlap / std::sqrt(2.0), pair.deepest.depth_error);
  ASSERT_EQ(pair.intervals.size(), 1u);
  EXPECT_EQ(pair.intervals[0].enter, 0.0);
  EXPECT_EQ(pair.intervals[0].exit, 0.1);
}

/// They cross, part and cross again within one cycle, between points of the shells.
TEST_F(CrossedRods, CrossingsThatPartWithinACycleAreSeveral) {
  Monitor monitor(rods(), soft());
  const PairResult pair = run(monitor, {across(kOverlap), across(-20.0 * kOverlap), across(kOverlap)});
  ASSERT_EQ(pair.verdict, Verdict::kContact);
  ASSERT_EQ(pair.intervals.size(), 2u);
  ASSERT_EQ(pair.peaks.size(), 2u);
  for (const ContactPoint& peak : pair.peaks) EXPECT_NEAR(peak.depth, kOverlap / std::sqrt(2.0), peak.depth_error);
  EXPECT_EQ(pair.intervals[0].enter, 0.0);
  EXPECT_LT(pair.intervals[0].exit, 0.05);
  EXPECT_GT(pair.intervals[1].enter, 0.05);
  EXPECT_EQ(pair.intervals[1].exit, 0.1);
}

/// In one cycle a rod goes through a block, and through the corner of a plate of the same body, without shell points
/// inside. The plate's corner is at 0.778 to 0.787 s, the block at 0.304 to 0.392 s.
TEST(HiddenCrossing, IsToldBesideAContactThatPointsFeel) {
  const double half = 0.0007, inside = 0.004;
  const Vector3d corner(0.125, 0.125, 0.0), along = Vector3d(1, -1, 0).normalized(),
                                            out = Vector3d(1, 1, 0).normalized();
  const Isometry3d turned = pose({0, 0, 0}, -kPi / 4, {0, 0, 1});
  BodyDescription plate = body("plate", Primitive(Box::fromSize({0.25, 0.25, 0.0002})));
  plate.geometry.push_back(
      {Primitive(Box::fromSize({0.1, 0.1, 0.24})), translation(corner + 0.5 * along) * turned, "block"});
  const BodyOptions options = optionsForContacts();
  const SceneDescription description{{plate, body("rod", Primitive(Box::fromSize({2.0 * half, 2.0 * half, 0.2})))}, {}};
  const auto scene =
      std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(options)), options));
  const auto at = [&](double s) {
    return translation(corner - inside * out + s * along + Vector3d(0, 0, 0.0031)) * turned;
  };
  Monitor monitor(scene, soft());
  const PairResult pair = monitor.run(cycle(1.0, {still(Isometry3d::Identity()), {at(0.9), at(-0.25)}}), {}).pairs[0];
  ASSERT_EQ(pair.intervals.size(), 2u);
  EXPECT_NEAR(pair.intervals[0].enter, (0.9 - 0.55 - half) / 1.15, 1e-3);
  EXPECT_NEAR(pair.intervals[1].enter, (0.9 - inside - 2.0 * half) / 1.15, 1e-4);
  EXPECT_NEAR(pair.intervals[1].exit, (0.9 + inside + 2.0 * half) / 1.15, 1e-4);
  ASSERT_EQ(pair.peaks.size(), 2u);
  for (const ContactPoint& peak : pair.peaks) EXPECT_GT(peak.depth, 0.9 * half);
}

/// A point of the rod lies on the plate's edge, exactly: it touches, while the plate's edge is deep in the rod.
TEST(HiddenCrossing, IsAsDeepWherePointsTouch) {
  for (const double half : {1.0 / 256, 1.0 / 128}) {
    const BodyOptions options = optionsForContacts();
    const SceneDescription description{{body("plate", Primitive(Box::fromSize({0.25, 0.25, 2.0 * (1.0 / 8192)}))),
                                        body("rod", Primitive(Box::fromSize({2.0 * half, 2.0 * half, 0.25})))},
                                       {}};
    const auto scene =
        std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(options)), options));
    Monitor monitor(scene, soft());
    for (int i = -200; i < 200; ++i) {
      monitor.reset();
      const Isometry3d there = translation({0.125 - half, i / 2048.0, 0.0421});
      const PairResult pair = monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(there)}), {}).pairs[0];
      ASSERT_EQ(pair.verdict, Verdict::kContact);
      EXPECT_NEAR(pair.deepest.depth, half, pair.deepest.depth_error) << i;
      EXPECT_LT(pair.deepest.depth_error, 1e-4) << i;
    }
  }
}

/// A rod goes right through a plate that is thinner than the distance of the rod's points, and where the plate has
/// none: the plate's surface is as deep in the rod as the rod's half width.
TEST(HiddenCrossing, IsAsDeepAsTheSurfaces) {
  Random random(5);
  for (const double plate : {0.1, 0.5}) {
    for (const double half : {0.004, 0.02}) {
      SceneDescription description;
      description.bodies = {body("plate", Primitive(Box::fromSize({2.0 * plate, 2.0 * plate, 0.0002}))),
                            body("rod", Primitive(Box::fromSize({2.0 * half, 2.0 * half, 0.2})))};
      for (const BodyOptions& options : {optionsForContacts(), optionsFor({0.01})}) {
        const auto scene = std::make_shared<const Scene>(
            buildScene(description, planScene(description, planOptions(options)), options));
        Monitor monitor(scene, soft());
        for (int i = 0; i < 20; ++i) {
          const auto anywhere = [&] { return uniform(random, -0.05, 0.05); };
          const Isometry3d there = translation({anywhere(), anywhere(), anywhere()});
          monitor.reset();
          const PairResult pair = monitor.run(cycle(0.1, {still(Isometry3d::Identity()), still(there)}), {}).pairs[0];
          ASSERT_EQ(pair.verdict, Verdict::kContact);
          EXPECT_NEAR(pair.deepest.depth, half, pair.deepest.depth_error) << plate;
          EXPECT_LT(pair.deepest.depth_error, 1e-4) << plate;
        }
      }
    }
  }
}

/// A rod that slides lengthwise through a thin plate crosses it all the time; hundreds of points feel it in turn.
TEST(HiddenCrossing, OfARodThatHundredsOfPointsFeelIsOneContact) {
  for (const double half_length : {0.3, 1.2}) {
    Monitor monitor(build({body("plate", Primitive(Box::fromSize({0.25, 0.25, 0.0002}))),
                           body("rod", Primitive(Box::fromSize({0.002, 0.0014, 2.0 * half_length})))},
                          optionsForContacts()),
                    {});
    const auto at = [&](double share) { return translation({0.0013, 0.0017, share * half_length}); };
    const PairResult pair = monitor.run(cycle(1.0, {still(Isometry3d::Identity()), {at(-0.9), at(0.9)}}), {}).pairs[0];
    ASSERT_EQ(pair.verdict, Verdict::kContact);
    ASSERT_EQ(pair.intervals.size(), 1u) << half_length;
    EXPECT_EQ(pair.intervals[0].enter, 0.0);
    EXPECT_EQ(pair.intervals[0].exit, 1.0);
  }
}

/// The rod cuts the plate's corner and then enters the block, and the first touch is known exactly.
TEST(HiddenCrossing, ThatIsTheFirstTouchHasAPlace) {
  const Vector3d corner(0.125, 0.125, 0.0), along = Vector3d(1, -1, 0).normalized(),
                                            out = Vector3d(1, 1, 0).normalized();
  Isometry3d turned = pose({0, 0, 0}, -kPi / 4, {0, 0, 1});
  BodyDescription plate = body("plate", Primitive(Box::fromSize({0.25, 0.25, 0.0002})));
  plate.geometry.push_back(
      {Primitive(Box::fromSize({0.1, 0.1, 0.24})), translation(corner + 0.5 * along) * turned, "block"});
  BodyOptions options = optionsForContacts();
  const auto scene = build({plate, body("rod", Primitive(Box::fromSize({0.0014, 0.0014, 0.2})))}, options);
  int contacts = 0;
  for (int i = 0; i < 20; ++i) {
    Monitor monitor(scene, {});
    const auto at = [&](double s) {
      return translation(corner - (0.002 + 1e-4 * i) * out + s * along + Vector3d(0, 0, 0.005 * i - 0.05)) * turned;
    };
    const CycleMotion motion = cycle(1.0, {still(Isometry3d::Identity()), {at(-0.1 - 0.01 * i), at(0.7)}});
    const CycleResult& result = monitor.run(motion, {});
    ContactTracker tracker(*scene);
    tracker.update({result, motion, motion.times, std::chrono::seconds(1000)});
    for (std::size_t k = 0; k < tracker.size(); ++k, ++contacts)
      EXPECT_GT(tracker[k].deepest.p_W.norm(), 0.1) << i << ": its place is not known";
  }
  EXPECT_GT(contacts, 20);
}

}  // namespace sdf_ccd::crossing_intervals_test
