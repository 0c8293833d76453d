// Contacts that are tracked while the world changes, or with maps.

#include <gtest/gtest.h>

#include <map>

#include "monitor/tracker_case.h"

namespace sdf_ccd::tracked_worlds_test {

using namespace test;

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

}  // namespace sdf_ccd::tracked_worlds_test
