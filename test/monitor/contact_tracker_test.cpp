#include "monitor/contact_tracker.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "monitor/scene_case.h"

namespace sdf_ccd {
namespace {

using namespace test;
using Time = std::chrono::nanoseconds;
using Pairs = std::vector<std::pair<std::string, std::string>>;

constexpr double kLength = 0.1;  // duration of a cycle [s]

/// A scene that has only names; `tiles` are the bodies that are tiles of the map "map".
Scene named(const Pairs& pairs, const std::set<std::string>& tiles) {
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

Time at(double seconds) {
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
};

class TrackerTest : public ::testing::Test {
 protected:
  void world(const Pairs& pairs, const std::set<std::string>& tiles = {}) {
    scene_ = named(pairs, tiles);
    if (tracker_) {
      tracker_->adopt(scene_);
    } else {
      tracker_ = std::make_unique<ContactTracker>(scene_);
    }
  }

  /// Runs the next cycle, or one that starts at the given time. Pairs without an entry are clear.
  void cycle(const std::vector<PairInput>& pairs, double start = -1.0) {
    if (start >= 0.0) now_ = start;
    CycleResult result;
    CycleMotion motion;
    motion.times = {0.0, kLength};
    result.verdict = Verdict::kClear;
    for (std::size_t i = 0; i < scene_.pairs.size(); ++i) {
      const PairInput input = i < pairs.size() ? pairs[i] : PairInput();
      PairResult pair;
      pair.body_a = scene_.pairs[i].body_a;
      pair.body_b = scene_.pairs[i].body_b;
      pair.verdict = input.verdict;
      if (input.is_delayed) {
        result.verdict = Verdict::kNotChecked;
      } else {
        pair.span = {0, 1};
      }
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
        pair.points.push_back(point);
        if (point.depth >= pair.deepest.depth) pair.deepest = point;
      }
      result.verdict = std::max(result.verdict, pair.verdict);
      result.pairs.push_back(pair);
    }
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
  std::unique_ptr<ContactTracker> tracker_;
  std::vector<double> samples_ = {0.0, kLength};
  double now_ = 100.0;
};

const PairInput kClear;
const PairInput kThrough{Verdict::kContact, {{0.0, kLength}}};

TEST_F(TrackerTest, AContactBeginsGoesOnAndEndsUnderOneId) {
  world({{"hand", "table"}, {"foot", "table"}});
  cycle({});
  EXPECT_EQ(tracker_->size(), 0u);
  cycle({kClear, {Verdict::kContact, {{0.04, kLength, 0.01}}}});
  EXPECT_EQ(only().id, 1u);
  EXPECT_TRUE(only().begins);
  EXPECT_FALSE(only().ends);
  EXPECT_EQ(only().body_a, "foot");
  EXPECT_EQ(only().begin, at(100.14));
  EXPECT_NEAR(only().max_force, 6.0 * kLength / 0.06, 1e-9);
  cycle({kClear, {Verdict::kContact, {{0.0, kLength, 0.03}}}});
  EXPECT_EQ(only().id, 1u);
  EXPECT_FALSE(only().begins || only().ends);
  EXPECT_EQ(tracker_->open(), 1u);
  cycle({kClear, {Verdict::kContact, {{0.0, 0.05, 0.02}}}});
  EXPECT_EQ(only().id, 1u);
  EXPECT_TRUE(only().ends);
  EXPECT_FALSE(only().is_lost);
  EXPECT_EQ(only().begin, at(100.14));
  EXPECT_EQ(only().end, at(100.35));
  EXPECT_EQ(only().deepest.depth, 0.03);
  EXPECT_EQ(only().deepest_origin, at(100.2));
  EXPECT_EQ(only().cycles, 3u);
  EXPECT_EQ(tracker_->open(), 0u);
  cycle({});
  EXPECT_EQ(tracker_->size(), 0u);
  cycle({kClear, kThrough});
  EXPECT_EQ(only().id, 2u);
}

TEST_F(TrackerTest, AContactUpToTheCyclesEndEndsInTheNextOne) {
  world({{"hand", "table"}});
  cycle({kThrough});
  EXPECT_FALSE(only().ends);
  cycle({});
  EXPECT_TRUE(only().ends);
  EXPECT_EQ(only().end, at(100.1));
  cycle({});
  EXPECT_EQ(tracker_->size(), 0u);
}

TEST_F(TrackerTest, BreaksShorterThanAMillisecondAreNone) {
  world({{"hand", "table"}});
  cycle({{Verdict::kContact, {{0.0, 0.0500}, {0.0509, 0.0995}}}});
  EXPECT_EQ(only().id, 1u);
  EXPECT_FALSE(only().ends);
  cycle({{Verdict::kContact, {{0.0004, 0.05}, {0.0511, 0.0995}}}});
  ASSERT_EQ(tracker_->size(), 2u);
  EXPECT_EQ(listed()[0].id, 1u);
  EXPECT_TRUE(listed()[0].ends);
  EXPECT_TRUE(listed()[1].begins);
  EXPECT_FALSE(listed()[1].ends);
}

TEST_F(TrackerTest, WhetherAContactIsSureFollowsFromItsOwnPoints) {
  world({{"a", "b"}});
  const auto verdicts = [&](const std::vector<PairInput>& cycles) {
    tracker_->endAllAsLost();
    std::map<std::uint64_t, Verdict> by_id;
    for (const PairInput& each : cycles) {
      cycle({each});
      for (const TrackedContact& contact : listed()) by_id[contact.id] = contact.verdict;
    }
    std::string text;
    for (const auto& [id, verdict] : by_id) text += std::string(toString(verdict)) + " ";
    return text;
  };
  constexpr Verdict kContact = Verdict::kContact, kUncertain = Verdict::kUncertain;
  // Less deep than the largest error of the field, but deeper than its error at that point.
  EXPECT_EQ(verdicts({{kContact, {{0.0, 0.02, 0.001, 0.0002}}}}), "CONTACT ");
  // As in an open mesh: deeper than the error bound, but perhaps only inside a cap.
  EXPECT_EQ(verdicts({{kUncertain, {{0.0, 0.02, 0.01, 0.01}}}}), "UNCERTAIN ");
  // The surfaces are known to cross, although no depth proves it.
  EXPECT_EQ(verdicts({{kContact, {{0.0, 0.02, 0.0, 0.0}}}}), "CONTACT ");
  // One of two intervals in a cycle is proved.
  EXPECT_EQ(verdicts({{kContact, {{0.0, 0.02, 0.0001, 0.0002}, {0.03, 0.05, 0.001, 0.0002}}}}), "UNCERTAIN CONTACT ");
  // One contact over two cycles: the second cycle proves it, although it is less deep there.
  EXPECT_EQ(verdicts({{kUncertain, {{0.05, 0.1, 0.002, 0.003}}}, {kContact, {{0.0, 0.05, 0.001, 0.0002}}}}),
            "CONTACT ");
}

TEST_F(TrackerTest, SamplesSeeWhatTheyHit) {
  world({{"hand", "table"}});
  cycle({{Verdict::kContact, {{0.02, 0.05}}}});
  EXPECT_FALSE(only().seen_at_samples);
  cycle({{Verdict::kContact, {{0.05, 0.1}}}});
  EXPECT_TRUE(listed().back().seen_at_samples);
}

TEST_F(TrackerTest, DelayKeepsAContactAndWhatIsNotCheckedLosesIt) {
  world({{"hand", "table"}});
  cycle({kThrough});
  PairInput delayed{Verdict::kNotChecked, {}, true};
  cycle({delayed});
  EXPECT_FALSE(only().ends);
  cycle({kThrough}, 100.1);  // the delayed cycle
  EXPECT_EQ(only().id, 1u);
  cycle({{Verdict::kNotChecked, {}}});
  EXPECT_TRUE(only().ends && only().is_lost);
  cycle({kThrough});
  EXPECT_EQ(only().id, 2u);
  EXPECT_TRUE(only().begins);
}

TEST_F(TrackerTest, TimesCheckedAgainJoinTheContactThatTheyMeet) {
  world({{"hand", "table"}});
  cycle({{Verdict::kContact, {{0.02, 0.05}}}});
  EXPECT_TRUE(only().ends);
  cycle({{Verdict::kContact, {{0.04, 0.1}}}}, 100.0);
  EXPECT_EQ(only().id, 1u);
  EXPECT_FALSE(only().ends || only().begins);
  EXPECT_EQ(only().begin, at(100.02));
  EXPECT_EQ(only().end, at(100.1));
  EXPECT_EQ(tracker_->open(), 1u);
  cycle({});
  EXPECT_TRUE(only().ends);
}

TEST_F(TrackerTest, AnEarlierTouchThatIsFoundLaterLeavesTheContactThatGoesOn) {
  world({{"hand", "table"}});
  cycle({{Verdict::kContact, {{0.08, 0.1}}}});
  // The same times again: two touches before that contact, which goes on.
  cycle({{Verdict::kContact, {{0.01, 0.02}, {0.04, 0.05}, {0.0505, 0.06}, {0.08, 0.1}}}}, 100.0);
  ASSERT_EQ(tracker_->size(), 3u);
  EXPECT_EQ(tracker_->open(), 1u);
  std::map<std::uint64_t, TrackedContact> by_id;
  for (const TrackedContact& contact : said()) by_id[contact.id] = contact;
  EXPECT_FALSE(by_id[1].begins || by_id[1].ends);
  EXPECT_EQ(by_id[1].begin, at(100.08));
  EXPECT_TRUE(by_id[2].begins && by_id[2].ends && by_id[3].begins && by_id[3].ends);
  EXPECT_FALSE(by_id[2].is_lost || by_id[3].is_lost);
  EXPECT_EQ(by_id[2].end, at(100.02));
  EXPECT_EQ(by_id[3].begin, at(100.04));
  EXPECT_EQ(by_id[3].end, at(100.06));
  cycle({kThrough});
  EXPECT_EQ(only().id, 1u);
  cycle({});
  EXPECT_TRUE(only().ends);
  cycle({kThrough});
  EXPECT_EQ(only().id, 4u);
}

TEST_F(TrackerTest, NothingGoesOnAfterAJump) {
  world({{"hand", "table"}, {"foot", "table"}});
  cycle({kThrough, kThrough});
  tracker_->clearEvents();
  EXPECT_EQ(tracker_->size(), 2u);
  EXPECT_FALSE(listed()[0].begins);
  tracker_->endAllAsLost();
  ASSERT_EQ(tracker_->size(), 2u);
  EXPECT_TRUE(listed()[0].ends && listed()[0].is_lost && listed()[1].is_lost);
  tracker_->endAllAsLost();
  tracker_->clearEvents();
  EXPECT_EQ(tracker_->size(), 0u);
  cycle({kThrough}, 100.0);
  EXPECT_EQ(only().id, 3u);
}

TEST_F(TrackerTest, AnotherWorldKeepsContactsByName) {
  world({{"hand", "table"}, {"foot", "table"}, {"foot", "box"}});
  cycle({kThrough, kThrough, kThrough});
  // In reverse order of names and of pairs, without the box, with a new body.
  world({{"table", "foot"}, {"new", "table"}, {"table", "hand"}});
  for (const TrackedContact& contact : listed()) EXPECT_EQ(contact.is_lost, contact.id == 3);
  cycle({kThrough, kThrough, kThrough});
  std::map<std::uint64_t, TrackedContact> by_id;
  for (const TrackedContact& contact : listed()) by_id[contact.id] = contact;
  ASSERT_EQ(by_id.size(), 4u);
  EXPECT_TRUE(by_id[3].ends && by_id[3].is_lost);
  EXPECT_EQ(by_id[1].body_a, "hand");
  EXPECT_EQ(by_id[2].body_a, "foot");
  EXPECT_FALSE(by_id[1].begins || by_id[2].begins);
  EXPECT_EQ(by_id[4].body_a, "new");
  EXPECT_TRUE(by_id[4].begins);
  tracker_->clearEvents();
  // The other pairs are gone: their contacts are reported as lost at once.
  world({{"hand", "table"}});
  ASSERT_EQ(tracker_->size(), 3u);
  for (const TrackedContact& contact : listed()) EXPECT_EQ(contact.is_lost, contact.id != 1);
  EXPECT_EQ(tracker_->open(), 1u);
  // They are reported again in the next cycle, whose message is the first one since, and only in that.
  tracker_->clearEvents();
  EXPECT_EQ(tracker_->size(), 1u);
  cycle({kThrough});
  ASSERT_EQ(tracker_->size(), 3u);
  for (const TrackedContact& contact : listed()) EXPECT_EQ(contact.ends && contact.is_lost, contact.id != 1);
  cycle({kThrough});
  EXPECT_EQ(only().id, 1u);
}

TEST_F(TrackerTest, ANormalPointsFromTheFirstBodyAlsoWhereAnotherWorldHasThemTheOtherWayRound) {
  world({{"hand", "table"}});
  cycle({kThrough});
  const Vector3d before = only().deepest.normal_W;
  world({{"table", "hand"}});
  cycle({{Verdict::kContact, {{0.0, kLength, 0.02}}}});  // deeper, with the normal from A to B
  EXPECT_EQ(only().body_a, "hand");
  EXPECT_EQ(only().deepest.depth, 0.02);
  EXPECT_EQ(only().deepest.normal_W, -before);
}

/// Expected contacts, from all intervals at once: intervals of each pair, joined across short breaks.
std::multiset<std::tuple<std::string, Time, Time>> joined(
    std::map<std::string, std::vector<std::pair<Time, Time>>> all) {
  std::multiset<std::tuple<std::string, Time, Time>> contacts;
  for (auto& [name, intervals] : all) {
    std::sort(intervals.begin(), intervals.end());
    for (std::size_t i = 0; i < intervals.size();) {
      Time end = intervals[i].second;
      std::size_t k = i + 1;
      while (k < intervals.size() && intervals[k].first <= end + ContactTracker::kJoin)
        end = std::max(end, intervals[k++].second);
      contacts.insert({name, intervals[i].first, end});
      i = k;
    }
  }
  return contacts;
}

TEST_F(TrackerTest, AnyRunSaysWhatAllIntervalsTogetherSay) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Pairs pairs = {{"a", "b"}, {"b", "c"}, {"a", "c"}, {"c", "d"}};
  for (int run = 0; run < 30; ++run) {
    tracker_.reset();
    world(pairs);
    now_ = 100.0;
    std::map<std::string, std::vector<std::pair<Time, Time>>> all;
    std::map<std::uint64_t, TrackedContact> by_id;
    std::set<std::uint64_t> ended;
    for (int i = 0; i < 60; ++i) {
      if (i % 7 == 0) {
        std::shuffle(pairs.begin(), pairs.end(), random);
        world(pairs);
      }
      std::vector<PairInput> cycles;
      for (std::size_t p = 0; p < pairs.size(); ++p) {
        PairInput one;
        double t = uniform(random) < 0.5 ? 0.0 : 0.05 * uniform(random);
        while (uniform(random) < 0.6 && t < kLength) {
          const double end = std::min(kLength, t + 0.08 * uniform(random));
          one.touches.push_back({t, end});
          t = end + (uniform(random) < 0.5 ? 0.0009 : 0.0011 + 0.05 * uniform(random));
        }
        if (!one.touches.empty()) one.verdict = Verdict::kContact;
        const std::string name = std::min(pairs[p].first, pairs[p].second) + std::max(pairs[p].first, pairs[p].second);
        for (const Touch& touch : one.touches) {
          all[name].push_back({at(now_) + at(touch.enter), at(now_) + at(touch.exit)});
        }
        cycles.push_back(one);
      }
      cycle(cycles);
      std::set<std::uint64_t> ids;
      for (const TrackedContact& contact : listed()) {
        EXPECT_TRUE(ids.insert(contact.id).second);
        EXPECT_EQ(contact.begins, by_id.count(contact.id) == 0);
        EXPECT_EQ(ended.count(contact.id), 0u);
        by_id[contact.id] = contact;
        if (contact.ends) ended.insert(contact.id);
      }
      for (const auto& [id, contact] : by_id) EXPECT_TRUE(ended.count(id) > 0 || ids.count(id) > 0);
    }
    std::multiset<std::tuple<std::string, Time, Time>> tracked;
    for (const auto& [id, contact] : by_id) {
      const auto& [a, b] = std::minmax(contact.body_a, contact.body_b);
      tracked.insert({a + b, contact.begin, contact.end});
    }
    EXPECT_EQ(tracked, joined(all));
  }
}

TEST_F(TrackerTest, WhatSlidesOverTilesOfAMapIsOneContact) {
  world({{"hand", "map/0_0_-1"}, {"hand", "map/1_0_-1"}, {"arm", "map/0_0_-1"}, {"hand", "map/x"}},
        {"map/0_0_-1", "map/1_0_-1"});
  cycle({{Verdict::kContact, {{0.05, 0.1, 0.004}}}});
  const std::uint64_t id = listed().at(0).id;
  EXPECT_EQ(listed()[0].body_a, "hand");
  EXPECT_EQ(listed()[0].body_b, "map");
  // It leaves the first tile while it touches the second one, whose interval starts earlier in the cycle.
  cycle({{Verdict::kContact, {{0.02, 0.06, 0.005}}}, {Verdict::kContact, {{0.0, 0.03, 0.002}, {0.055, 0.1, 0.008}}}});
  ASSERT_EQ(listed().size(), 1u);
  EXPECT_EQ(listed()[0].id, id);
  EXPECT_EQ(listed()[0].cycles, 2u);
  EXPECT_DOUBLE_EQ(listed()[0].deepest.depth, 0.008);
  // Both tiles are replaced, and the map gets another one.
  world({{"arm", "map/0_0_-1"}, {"map/5_5_5", "hand"}, {"hand", "map/1_0_-1"}, {"hand", "map/x"}},
        {"map/0_0_-1", "map/1_0_-1", "map/5_5_5"});
  cycle({{}, {}, {Verdict::kContact, {{0.0, 0.04, 0.002}}}});
  ASSERT_EQ(listed().size(), 1u);
  EXPECT_EQ(listed()[0].id, id);
  EXPECT_TRUE(listed()[0].ends);
  EXPECT_FALSE(listed()[0].is_lost);
  EXPECT_EQ(listed()[0].end - listed()[0].begin, at(0.19));
  // Pairs without tiles are tracked separately.
  cycle({{Verdict::kContact, {{0.0, 0.1}}}, {}, {Verdict::kContact, {{0.0, 0.1}}}, {Verdict::kContact, {{0.0, 0.1}}}});
  EXPECT_EQ(listed().size(), 3u);
}

TEST_F(TrackerTest, OfTilesOnlyWhatNobodySeesIsLost) {
  world({{"hand", "map/0_0_0"}, {"hand", "map/1_0_0"}}, {"map/0_0_0", "map/1_0_0"});
  cycle({{Verdict::kContact, {{0.05, 0.1}}}});
  cycle({{Verdict::kNotChecked, {}}, {Verdict::kContact, {{0.0, 0.1}}}});
  ASSERT_EQ(listed().size(), 1u);
  EXPECT_FALSE(listed()[0].ends);
  cycle({{Verdict::kNotChecked, {}}});
  ASSERT_EQ(listed().size(), 1u);
  EXPECT_TRUE(listed()[0].ends);
  EXPECT_TRUE(listed()[0].is_lost);
}

TEST_F(TrackerTest, WhatIsOnlyCalledLikeAMapOrItsTileIsItself) {
  const Pairs pairs = {{"hand", "map/0_0_0"}, {"hand", "map/1_0_0"}, {"hand", "map"}};
  const PairInput touches{Verdict::kContact, {{0.0, 0.1}}};
  world(pairs, {"map/0_0_0"});
  cycle({touches, touches, touches});
  ASSERT_EQ(listed().size(), 3u);
  const std::vector<TrackedContact> before = listed();
  EXPECT_EQ(before[0].body_b, "map");
  EXPECT_EQ(before[1].body_b, "map/1_0_0");
  EXPECT_EQ(before[2].body_b, "map");
  // In another order, each contact continues or ends as before.
  world({pairs[2], pairs[1], pairs[0]}, {"map/0_0_0"});
  cycle({{}, touches, touches});
  ASSERT_EQ(listed().size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(listed()[i].id, before[i].id);
    EXPECT_EQ(listed()[i].ends, i == 2);
  }
}

}  // namespace
}  // namespace sdf_ccd
