#include "sdf_ccd/monitor.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "monitor/tracker_case.h"
#include "oracle/scene_case.h"

namespace sdf_ccd::contact_tracker_test {

using namespace test;

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

/// Poses with a noise of 0.02 mm beside a surface: touches of 20 ms, every 45 ms, for 5 s.
TEST_F(TrackerTest, NoiseMakesOneContactNotAHundred) {
  for (const bool joins : {false, true}) {
    tracker_.reset();
    join_ = joins ? ContactJoin{at(0.1), 5e-4} : ContactJoin();
    world({{"hand", "table"}});
    std::set<std::uint64_t> ids;
    for (int i = 0; i < 50; ++i) {
      PairInput input{Verdict::kContact, {}, false, 0.0};
      for (int k = 0; k < 112; ++k) {
        const double enter = 0.045 * k - kLength * i;
        if (enter >= 0.0 && enter + 0.02 <= kLength) input.touches.push_back({enter, enter + 0.02, 1e-5});
      }
      if (input.touches.empty()) input = {Verdict::kClear, {}, false, 2e-5};
      cycle({input});
      for (const TrackedContact& contact : listed()) ids.insert(contact.id);
    }
    if (joins) {
      EXPECT_EQ(ids.size(), 1u);
    } else {
      EXPECT_GT(ids.size(), 80u);
    }
  }
}

TEST_F(TrackerTest, ABreakInWhichTheBodiesWereApartIsOneHoweverShortItIs) {
  join_ = {at(0.5), 5e-4};
  world({{"ball", "table"}});
  cycle({{Verdict::kContact, {{0.0, 0.09}}}});
  cycle({{Verdict::kClear, {}, false, 4e-4}});
  EXPECT_FALSE(only().ends) << "not farther apart than the distance";
  cycle({{Verdict::kClear, {}, false, 6e-4}});
  EXPECT_TRUE(only().ends);
  EXPECT_EQ(only().end, at(100.09));
  cycle({{Verdict::kContact, {{0.02, 0.09}}}});
  EXPECT_EQ(only().id, 2u);
  EXPECT_TRUE(only().begins);
  for (int i = 0; i < 5; ++i) cycle({{Verdict::kClear, {}, false, 1e-4}});
  EXPECT_TRUE(only().ends) << "not seen for longer than a break";
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

/// Within one cycle a ball dips into a block by 20, 30 and 20 mm: all of the deepest points are of the second dip.
TEST(ContactTracker, EachContactOfACycleHasItsOwnDepth) {
  const auto scene =
      build({body("ball", Primitive(Sphere{0.1})), body("block", Primitive(Box::fromSize({1.0, 1.0, 0.2})), true)},
            fine(0.01));
  std::vector<Isometry3d> ball;
  for (const double depth : {-0.05, 0.02, -0.05, 0.03, -0.05, 0.02, -0.05})
    ball.push_back(translation({0, 0, 0.2 - depth}));
  const CycleMotion motion = test::cycle(0.6, {ball, still(Isometry3d::Identity(), ball.size())});
  for (const int max_points : {0, 5}) {
    Monitor monitor(scene, soft());
    const CycleResult result = monitor.run(motion, {false, max_points});
    ASSERT_EQ(result.pairs[0].intervals.size(), 3u);
    EXPECT_EQ(result.pairs[0].points.size(), std::size_t(max_points));
    ContactTracker tracker(*scene);
    tracker.update({result, motion, motion.times, std::chrono::seconds(100)});
    ASSERT_EQ(tracker.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(tracker[i].verdict, Verdict::kContact);
      EXPECT_NEAR(tracker[i].deepest.depth, i == 1 ? 0.03 : 0.02, 1e-3) << max_points;
      EXPECT_NEAR(tracker[i].deepest.time, 0.1 + 0.2 * double(i), 1e-2);
    }
  }
}

/// The second dip is less deep than depths are searched for, but the surfaces certainly cross.
TEST(ContactTracker, AShallowContactThatIsMeasuredIsACertainOne) {
  const auto scene =
      build({body("ball", Primitive(Sphere{0.1})), body("block", Primitive(Box::fromSize({1.0, 1.0, 0.2})), true)},
            fine(0.01));
  std::vector<Isometry3d> ball;
  for (const double depth : {-0.05, 0.02, -0.05, 2e-5, -0.05}) ball.push_back(translation({0, 0, 0.2 - depth}));
  const CycleMotion motion = test::cycle(0.4, {ball, still(Isometry3d::Identity(), ball.size())});
  Monitor monitor(scene, soft());
  const CycleResult result = monitor.run(motion, {});
  ASSERT_EQ(result.pairs[0].intervals.size(), 2u);
  ContactTracker tracker(*scene);
  tracker.update({result, motion, motion.times, std::chrono::seconds(100)});
  ASSERT_EQ(tracker.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(tracker[i].verdict, Verdict::kContact) << i;
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
  for (const TrackedContact& contact : listed()) by_id[contact.id] = contact;
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

}  // namespace sdf_ccd::contact_tracker_test
