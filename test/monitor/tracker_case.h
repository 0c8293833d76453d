#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "monitor/summarise.h"
#include "sdf_ccd/monitor.h"

namespace sdf_ccd::test {

using Time = std::chrono::nanoseconds;
using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr double kLength = 0.1;  // duration of a cycle [s]

/// A scene that has only names; `tiles` are the bodies that are tiles of the map "map".
inline Scene named(const Pairs& pairs, const std::set<std::string>& tiles) {
  Scene scene;
  std::map<std::string, int> bodies;
  const auto indexOf = [&](const std::string& name) {
    const auto [found, is_new] = bodies.try_emplace(name, static_cast<int>(scene.bodies.size()));
    if (is_new) {
      Body body;
      body.name = name;
      if (tiles.count(name) > 0) body.map = "map";
      scene.bodies.push_back(std::move(body));
    }
    return found->second;
  };
  for (const auto& [a, b] : pairs) {
    PlannedPair pair;
    pair.body_a = indexOf(a);
    pair.body_b = indexOf(b);
    scene.pairs.push_back(pair);
  }
  return scene;
}

inline Time at(double seconds) {
  return Time(std::llround(1e9 * seconds));
}

struct Touch {
  double enter, exit;  // relative to the cycle's start [s]
  double depth = 0.01, depth_error = 0.0;
};

/// The result of one pair in a cycle.
struct PairInput {
  Verdict verdict = Verdict::kClear;
  std::vector<Touch> touches;
  bool is_delayed = false;
  double clearance = 0.0;  // of a pair that is clear, at the cycle's end [m]
};

class TrackerTest : public ::testing::Test {
 protected:
  void world(const Pairs& pairs, const std::set<std::string>& tiles = {}) {
    scene_ = named(pairs, tiles);
    if (tracker_) {
      tracker_->adopt(scene_);
    } else {
      tracker_ = std::make_unique<ContactTracker>(scene_, join_);
    }
  }

  /// Runs the next cycle, or one that starts at the given time. Pairs without an entry are clear.
  void cycle(const std::vector<PairInput>& pairs, double start = -1.0) {
    if (start >= 0.0) now_ = start;
    CycleResult result;
    CycleMotion motion;
    motion.times = {0.0, kLength};
    for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
      const PairInput input = i < pairs.size() ? pairs[i] : PairInput();
      PairResult pair;
      pair.body_a = scene_.pairs[i].body_a;
      pair.body_b = scene_.pairs[i].body_b;
      pair.verdict = input.verdict;
      pair.clearance = input.clearance;
      if (!input.is_delayed) pair.span = {0, 1};
      pair.error = {0.0, 0.0001, 0.0, 0.0};  // of the verdict, from triangles; depths have the fields' errors
      pair.contact_error = {0.003, 0.0001, 0.0, 0.001};
      pair.on_a_W.force = Vector3d(0.0, 0.0, 6.0);
      for (const Touch& touch : input.touches) {
        pair.intervals.push_back({touch.enter, touch.exit});
        ContactPoint point;
        point.enter = point.time = touch.enter;
        point.exit = touch.exit;
        point.depth = touch.depth;
        point.depth_error = touch.depth_error;
        point.normal_W = Vector3d::UnitZ();
        pair.peaks.push_back(point);
        if (point.depth >= pair.deepest.depth) pair.deepest = point;
      }
      result.pairs.push_back(pair);
    }
    summarise(result);
    tracker_->update({result, motion, samples_, at(now_)});
    now_ += kLength;
  }

  std::vector<TrackedContact> listed() const {
    std::vector<TrackedContact> all;
    for (std::size_t i = 0; i < tracker_->size(); ++i) all.push_back((*tracker_)[i]);
    return all;
  }
  TrackedContact only() const {
    EXPECT_EQ(tracker_->size(), 1u);
    return tracker_->size() == 1 ? (*tracker_)[0] : TrackedContact();
  }

  Scene scene_;
  ContactJoin join_;
  std::unique_ptr<ContactTracker> tracker_;
  std::vector<double> samples_ = {0.0, kLength};
  double now_ = 100.0;
};

inline const PairInput kClear;
inline const PairInput kThrough{Verdict::kContact, {{0.0, kLength}}};

}  // namespace sdf_ccd::test
