#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <tbb/global_control.h>

#include "robot/planned_motion.h"
#include "robot_monitor/check_motion_case.h"

namespace sdf_ccd::check_motions_test {

using namespace test;

/// Random rotations of the rod among posts.
class CheckMotionsTest : public CheckMotionTest {
 protected:
  static constexpr double kPost = 2.0, kOther = 4.0;  // angles of the posts [rad]
  const double half_angle_ = std::asin(0.04 / 0.9);   // from the post's angle at which the rod touches it
  const std::shared_ptr<const Scene> scene_ = sceneOf(posts());

  std::vector<BodyDescription> posts() const {
    std::vector<BodyDescription> posts = {post("base", kPost), post("base", kOther)};
    posts[1].name = "other";
    return posts;
  }

  /// Start and end angles, up to 0.6 rad apart.
  static std::vector<std::array<double, 2>> turns(std::size_t count) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> from(0.0, 6.0), by(-0.6, 0.6);
    std::vector<std::array<double, 2>> turns(count);
    for (auto& [start, end] : turns) {
      start = from(random);
      end = start + by(random);
    }
    return turns;
  }

  std::vector<MotionVerdict> check(const std::vector<std::array<double, 2>>& turns,
                                   const MotionsRequest& request = {}) const {
    const auto motion = [&](std::size_t i, double tolerance) {
      return motionOf(*scene_, {turns[i][0], turns[i][1]}, tolerance);
    };
    return checkMotions(scene_, {}, turns.size(), motion, request);
  }

  /// Angle by which the rod stays away from the posts; negative if it meets one.
  double freeAngle(const std::array<double, 2>& turn) const {
    const auto [low, high] = std::minmax(turn[0], turn[1]);
    double free = 10.0;
    for (const double post : {kPost, kOther, kPost - 2.0 * M_PI, kOther - 2.0 * M_PI, kPost + 2.0 * M_PI})
      free = std::min(free, std::max(low - post, post - high) - half_angle_);
    return free;
  }
};

TEST_F(CheckMotionsTest, EachIsAsIfAlone) {
  const auto all = turns(300);
  const std::vector<MotionVerdict> verdicts = check(all);
  int clear = 0, contact = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const MotionVerdict& found = verdicts[i];
    const double free = freeAngle(all[i]);
    if (free > 0.002) {
      ASSERT_EQ(found.verdict, Verdict::kClear) << i;
    }
    if (free < -0.002) {
      ASSERT_EQ(found.verdict, Verdict::kContact) << i;
    }
    const CycleResult alone = checkMotion(scene_, {}, motionOf(*scene_, {all[i][0], all[i][1]}));
    ASSERT_EQ(found.verdict, alone.verdict) << i;
    clear += found.verdict == Verdict::kClear;
    contact += found.verdict == Verdict::kContact;
    if (found.verdict == Verdict::kClear) {
      ASSERT_EQ(found.pair, -1);
      ASSERT_EQ(found.time, -1.0);
      continue;
    }
    ASSERT_GE(found.pair, 0);
    ASSERT_GE(found.time, 0.0);
    ASSERT_LE(found.time, 1.0);
    if (found.verdict == Verdict::kContact && std::abs(all[i][1] - all[i][0]) > 0.1) {
      const double at = all[i][0] + found.time * (all[i][1] - all[i][0]);
      const double post = scene_->bodies[scene_->pairs[std::size_t(found.pair)].body_b].name == "post" ? kPost : kOther;
      ASSERT_LE(std::abs(std::remainder(at - post, 2.0 * M_PI)), half_angle_ + 0.01);
    }
  }
  EXPECT_GT(clear, 100);
  EXPECT_GT(contact, 20);
}

/// Of two posts that are hit within one piece of the motion, the first one in time is told, not the first one in order.
TEST_F(CheckMotionsTest, TheFirstOfSeveralContactsIsTold) {
  std::vector<BodyDescription> two = {post("base", 2.0), post("base", 2.12)};
  two[1].name = "other";
  const std::shared_ptr<const Scene> scene = sceneOf(two);
  const auto turned = [&](double start, double end) {
    const auto motion = [&](std::size_t, double tolerance) { return motionOf(*scene, {start, end}, tolerance); };
    const MotionVerdict found = checkMotions(scene, {}, 1, motion).at(0);
    return scene->bodies[scene->pairs[std::size_t(found.pair)].body_b].name;
  };
  EXPECT_EQ(turned(1.9, 2.2), "post");
  EXPECT_EQ(turned(2.2, 1.9), "other");
}

/// The rod comes to each post after another time, and may start at one.
TEST_F(CheckMotionsTest, AllPairsAreListedWithTheirFirstContact) {
  std::vector<BodyDescription> posts = {post("base", 2.0), post("base", 2.5), post("base", 4.0)};
  posts[1].name = "second";
  posts[2].name = "far";
  const std::shared_ptr<const Scene> scene = sceneOf(posts);
  std::vector<std::vector<double>> motions = {{1.0, 3.0}, {3.0, 1.0}, {0.0, 1.0}, {2.0, 1.5}, {1.0, 3.0, 1.0}, {}};
  for (int k = 0; k <= 50; ++k) motions.back().push_back(1.0 + 0.05 * k);  // of several pieces
  MotionsRequest request;
  request.list_pairs = true;
  const auto motion = [&](std::size_t i, double tolerance) { return motionOf(*scene, motions[i], tolerance); };
  const std::vector<MotionVerdict> verdicts = checkMotions(scene, {}, motions.size(), motion, request);

  using Times = std::vector<std::pair<std::string, double>>;
  const double first = (1.0 - half_angle_) / 2.0, later = (1.5 - half_angle_) / 2.0, back = (0.5 - half_angle_) / 2.0;
  const std::vector<Times> expected = {{{"post", first}, {"second", later}},
                                       {{"second", back}, {"post", first}},
                                       {},
                                       {{"post", 0.0}},
                                       {{"post", first}, {"second", later}},
                                       {{"post", 40.0 * first}, {"second", 40.0 * later}}};
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const MotionVerdict& found = verdicts[i];
    EXPECT_EQ(found.verdict, expected[i].empty() ? Verdict::kClear : Verdict::kContact) << i;
    ASSERT_EQ(found.pairs.size(), expected[i].size()) << i;
    for (std::size_t k = 0; k < found.pairs.size(); ++k) {
      EXPECT_EQ(found.pairs[k].verdict, Verdict::kContact);
      EXPECT_EQ(scene->bodies[found.pairs[k].body_b].name, expected[i][k].first) << i;
      EXPECT_NEAR(found.pairs[k].time, expected[i][k].second, motions[i].size() > 3 ? 0.08 : 2e-3) << i;
    }
    if (found.pairs.empty()) continue;
    EXPECT_EQ(found.time, found.pairs[0].time);
    EXPECT_EQ(scene->pairs[std::size_t(found.pair)].body_b, found.pairs[0].body_b);
  }
}

TEST_F(CheckMotionsTest, ListedPairsAreThoseOfTheMotionAlone) {
  const auto all = turns(300);
  MotionsRequest request;
  request.list_pairs = true;
  for (const double margin : {0.0, 0.05}) {
    request.margin = margin;
    const std::vector<MotionVerdict> verdicts = check(all, request);
    std::size_t listed = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      CycleRequest of_one;
      of_one.margin = margin;
      const CycleResult alone = checkMotion(scene_, {}, motionOf(*scene_, {all[i][0], all[i][1]}), of_one);
      ASSERT_EQ(verdicts[i].verdict, alone.verdict) << i;
      std::size_t not_clear = 0;
      for (const PairResult& pair : alone.pairs) {
        if (pair.verdict == Verdict::kClear) continue;
        ++not_clear;
        const auto same = std::find_if(verdicts[i].pairs.begin(), verdicts[i].pairs.end(), [&](const MotionPairVerdict& of) {
          return of.body_a == pair.body_a && of.body_b == pair.body_b;
        });
        ASSERT_NE(same, verdicts[i].pairs.end()) << i;
        ASSERT_EQ(same->verdict, pair.verdict) << i;
        if (!pair.intervals.empty()) {
          ASSERT_DOUBLE_EQ(same->time, pair.intervals.front().enter) << i;
        }
      }
      ASSERT_EQ(verdicts[i].pairs.size(), not_clear) << i;
      listed += not_clear;
    }
    EXPECT_GT(listed, 20U);
  }
}

TEST_F(CheckMotionsTest, PairsThatCannotBeCheckedAreListedToo) {
  std::vector<BodyDescription> two = {post("base", 2.0), post("map", 2.5)};
  two[1].name = "lost";
  const std::shared_ptr<const Scene> scene = sceneOf(two);
  MotionsRequest request;
  request.list_pairs = true;
  const auto motion = [&](std::size_t, double tolerance) { return motionOf(*scene, {1.0, 3.0}, tolerance); };
  const MotionVerdict found = checkMotions(scene, {}, 1, motion, request).at(0);
  EXPECT_EQ(found.verdict, Verdict::kContact);
  ASSERT_EQ(found.pairs.size(), 2U);
  EXPECT_EQ(scene->bodies[found.pairs[0].body_b].name, "lost");
  EXPECT_EQ(found.pairs[0].verdict, Verdict::kNotChecked);
  EXPECT_EQ(found.pairs[0].time, 0.0);
  EXPECT_EQ(scene->bodies[found.pairs[1].body_b].name, "post");
  EXPECT_NEAR(found.time, (1.0 - half_angle_) / 2.0, 2e-3);
}

TEST_F(CheckMotionsTest, TheSameOnOneThread) {
  const auto all = turns(200);
  const std::vector<MotionVerdict> many = check(all);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<MotionVerdict> single = check(all);
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(many[i].verdict, single[i].verdict);
    ASSERT_EQ(many[i].pair, single[i].pair);
    ASSERT_EQ(many[i].time, single[i].time);
    ASSERT_EQ(many[i].error_bound, single[i].error_bound);
  }
}

TEST_F(CheckMotionsTest, AMarginIsKept) {
  MotionsRequest request;
  request.margin = 0.05;
  const auto all = turns(300);
  const std::vector<MotionVerdict> verdicts = check(all, request), without = check(all);
  int within = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double free = freeAngle(all[i]), distance = 0.9 * std::sin(std::min(free + half_angle_, 1.0)) - 0.04;
    ASSERT_GE(verdicts[i].verdict != Verdict::kClear, without[i].verdict != Verdict::kClear) << i;
    if (distance < 0.049) {
      ASSERT_NE(verdicts[i].verdict, Verdict::kClear) << i;
    }
    if (distance > 0.055) {
      ASSERT_EQ(verdicts[i].verdict, Verdict::kClear) << i;
    }
    ASSERT_LT(verdicts[i].error_bound, verdicts[i].verdict == Verdict::kClear ? 0.02 : 0.01);
    within += verdicts[i].verdict == Verdict::kUncertain;
  }
  EXPECT_GT(within, 10);
  for (const double wrong : {-1.0, 1e10, 1e300, std::nan("")}) {  // the bound is a sum with the margin
    request.margin = wrong;
    EXPECT_THROW(check(all, request), std::invalid_argument) << wrong;
  }
  request.margin = kLargestMargin;
  for (const MotionVerdict& verdict : check({all.front()}, request)) EXPECT_GT(verdict.error_bound, 0.0);
  request = {};
  request.tolerances.clear();
  EXPECT_THROW(check(all, request), std::invalid_argument);
}

TEST_F(CheckMotionsTest, WhatMakesAMotionMayThrow) {
  const auto motion = [&](std::size_t i, double) -> PlannedMotion {
    if (i == 7) throw std::invalid_argument("seven");
    return motionOf(*scene_, {0.0, 0.1});
  };
  EXPECT_THROW(checkMotions(scene_, {}, 20, motion), std::invalid_argument);
  EXPECT_TRUE(checkMotions(scene_, {}, 0, motion).empty());
}

}  // namespace sdf_ccd::check_motions_test
