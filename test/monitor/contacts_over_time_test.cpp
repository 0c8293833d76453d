#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "oracle/random.h"
#include "oracle/scene_case.h"
#include "sdf_ccd/monitor.h"

/// Contacts over time of a ball that flies past another one, on straight pieces, against the roots of quadratics.
/// Cycles are of any length, come late, and check times again.
namespace sdf_ccd::contacts_over_time_test {

using test::Random;
using test::uniform;
using Time = std::chrono::nanoseconds;

constexpr double kRadius = 0.1, kOther = 0.15, kReach = kRadius + kOther;

struct Path {
  std::vector<double> times;
  std::vector<Vector3d> points;

  Vector3d at(double time) const {
    const auto next = std::upper_bound(times.begin(), times.end(), time);
    const std::size_t k = std::clamp<std::ptrdiff_t>(next - times.begin(), 1, std::ptrdiff_t(times.size()) - 1);
    const double share = (time - times[k - 1]) / (times[k] - times[k - 1]);
    return points[k - 1] + share * (points[k] - points[k - 1]);
  }

  /// Times at which the centres are nearer than a distance.
  Intervals within(double distance) const {
    Intervals all;
    for (std::size_t k = 1; k < times.size(); ++k) {
      const Vector3d way = points[k] - points[k - 1];
      const double length = times[k] - times[k - 1], a = way.squaredNorm(), b = points[k - 1].dot(way),
                   c = points[k - 1].squaredNorm() - distance * distance, root = b * b - a * c;
      if (root <= 0.0) continue;
      const double from = std::max(0.0, (-b - std::sqrt(root)) / a), to = std::min(1.0, (-b + std::sqrt(root)) / a);
      if (from >= to) continue;
      const Interval piece{times[k - 1] + from * length, times[k - 1] + to * length};
      if (!all.empty() && piece.enter - all.back().exit < 1e-12)
        all.back().exit = piece.exit;
      else
        all.push_back(piece);
    }
    return all;
  }

  /// The smallest distance of the centres during an interval, from its ends and its waypoints' pieces.
  double nearest(const Interval& during) const {
    double least = std::min(at(during.enter).norm(), at(during.exit).norm());
    for (std::size_t k = 1; k < times.size(); ++k) {
      const Vector3d way = points[k] - points[k - 1];
      const double share = -points[k - 1].dot(way) / way.squaredNorm();
      const double time = times[k - 1] + share * (times[k] - times[k - 1]);
      if (share >= 0.0 && share <= 1.0 && time >= during.enter && time <= during.exit)
        least = std::min(least, at(time).norm());
      if (times[k] >= during.enter && times[k] <= during.exit) least = std::min(least, points[k].norm());
    }
    return least;
  }
};

Path anyPath(Random& random) {
  Path path;
  double time = 0.0;
  for (int i = 0; i < 40; ++i) {
    path.times.push_back(time);
    const double radius = random() % 2 == 0 ? kReach + uniform(random, -0.03, 0.01) : uniform(random, 0.1, 0.6);
    path.points.push_back(radius * test::direction(random));
    time += uniform(random, 0.005, 0.08);
  }
  path.points.front() = path.points.back() = {1.0, 0.0, 0.0};
  return path;
}

struct Seen {
  TrackedContact last;
  int begins = 0, ends = 0;
};

Interval secondsOf(const TrackedContact& contact) {
  return {std::chrono::duration<double>(contact.begin).count(), std::chrono::duration<double>(contact.end).count()};
}

TEST(ContactsOverTime, AreThoseOfTheExactMotion) {
  Random random(31);
  const auto scene = test::build(
      {test::body("ball", Primitive(Sphere{kRadius})), test::body("other", Primitive(Sphere{kOther}), true)},
      test::fine(0.006));
  int certain = 0, late = 0, again = 0;
  for (int run = 0; run < 12; ++run) {
    const Path path = anyPath(random);
    Monitor monitor(scene, test::soft());
    ContactTracker tracker(*scene);
    std::map<std::uint64_t, Seen> seen;
    double done = 0.0, now = 0.0, tolerance = 0.0;
    std::vector<double> samples;
    while (now < path.times.back()) {
      now = std::min(path.times.back(), now + uniform(random, 0.001, 0.15));
      const bool is_late = now < path.times.back() && random() % 4 == 0;
      const bool goes_back = !is_late && random() % 5 == 0;
      const double from = goes_back ? std::max(0.0, done - uniform(random, 0.0, 0.1)) : done;
      CycleMotion motion;
      motion.times = {0.0};
      for (const double time : path.times)
        if (time > from && time < now) motion.times.push_back(time - from);
      motion.times.push_back(now - from);
      motion.X_WB.resize(2);
      for (const double time : motion.times)
        motion.X_WB[scene->bodies[0].name == "ball" ? 0 : 1].push_back(test::translation(path.at(from + time)));
      motion.X_WB[scene->bodies[0].name == "ball" ? 1 : 0] = {Isometry3d::Identity()};
      if (is_late) motion.spans = {{0, 0}};
      late += is_late;
      again += goes_back;
      const CycleResult& result = monitor.run(motion, {});
      const double rounded = 1e-9 * std::round(1e9 * from);
      tracker.update({result, motion, motion.times, Time(std::llround(1e9 * rounded))});
      if (!is_late) {
        done = now;
        tolerance = std::max(tolerance, result.pairs[0].contact_error.total());
        for (const double time : motion.times) samples.push_back(from + time);
      }
      for (std::size_t i = 0; i < tracker.size(); ++i) {
        Seen& of_id = seen[tracker[i].id];
        of_id.last = tracker[i];
        of_id.begins += tracker[i].begins;
        of_id.ends += tracker[i].ends;
      }
    }
    ASSERT_LT(tolerance, 0.01);
    EXPECT_EQ(tracker.open(), 0u);
    // A contact that goes on must be deeper than the error; where the bodies are farther apart, there is none.
    const Intervals must = path.within(kReach - tolerance), may = path.within(kReach + tolerance);
    constexpr double kJoin = 1.1e-3;
    for (const Interval& interval : must) {
      ++certain;
      int covering = 0, touching = 0;
      for (const auto& [id, each] : seen) {
        const Interval found = secondsOf(each.last);
        covering += found.enter <= interval.enter + 1e-8 && interval.exit <= found.exit + 1e-8;
        touching += found.enter <= interval.exit && interval.enter <= found.exit;
      }
      EXPECT_EQ(covering, 1) << run << ": " << interval.enter << " to " << interval.exit;
      EXPECT_EQ(touching, 1) << run << ": " << interval.enter << " to " << interval.exit;
    }
    for (const auto& [id, each] : seen) {
      const Interval found = secondsOf(each.last);
      EXPECT_EQ(each.begins, 1) << run << ": " << id;
      EXPECT_GE(each.ends, 1) << run << ": " << id;  // once more if times were checked again
      EXPECT_FALSE(each.last.is_lost);
      Intervals joined;
      for (const Interval& one : may)
        if (!joined.empty() && one.enter - joined.back().exit < kJoin)
          joined.back().exit = one.exit;
        else
          joined.push_back(one);
      const bool is_within = std::any_of(joined.begin(), joined.end(), [&](const Interval& one) {
        return one.enter <= found.enter + 1e-8 && found.exit <= one.exit + 1e-8;
      });
      EXPECT_TRUE(is_within) << run << ": " << found.enter << " to " << found.exit;
      const double deepest = kReach - path.nearest(found);
      EXPECT_LE(each.last.deepest.depth - each.last.deepest.depth_error, deepest + 1e-6) << run << ": " << id;
      if (each.last.verdict == Verdict::kContact) {
        EXPECT_GT(deepest, 0.0) << run << ": " << id;
      }
      const bool hits = std::any_of(samples.begin(), samples.end(), [&](double time) {
        return time >= found.enter && time <= found.exit && path.at(time).norm() < kReach - tolerance;
      });
      const bool may_hit = std::any_of(samples.begin(), samples.end(), [&](double time) {
        return time >= found.enter - 1e-8 && time <= found.exit + 1e-8;
      });
      EXPECT_LE(hits, each.last.seen_at_samples) << run << ": " << id;
      EXPECT_LE(each.last.seen_at_samples, may_hit) << run << ": " << id;
    }
  }
  EXPECT_GT(certain, 30);
  EXPECT_GT(late, 20);
  EXPECT_GT(again, 15);
}

}  // namespace sdf_ccd::contacts_over_time_test
