#include "sdf_ccd/robot_monitor/check_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include <tbb/global_control.h>

#include "sdf_ccd/body/prepare_body.h"
#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd {
namespace {

/// A rod of 1 m that rotates about z at the origin.
const char* const kRod = R"(<robot name='r'>
  <link name='base'/>
  <link name='rod'><collision><origin xyz='0.5 0 0'/><geometry><box size='1 0.02 0.02'/></geometry></collision></link>
  <joint name='turn' type='continuous'><parent link='base'/><child link='rod'/><axis xyz='0 0 1'/></joint>
</robot>)";

class CheckMotionTest : public ::testing::Test {
 protected:
  BodyDescription post(const std::string& frame, double angle) const {
    BodyDescription post;
    post.name = "post";
    post.frame = frame;
    post.X_frame_B = Eigen::AngleAxisd(angle, Vector3d::UnitZ()) * Eigen::Translation3d(0.9, 0.0, 0.0);
    post.geometry.push_back({Primitive(Sphere{0.03}), Isometry3d::Identity(), "sphere"});
    post.is_world = true;
    return post;
  }

  CycleResult turn(const BodyDescription& post, const std::vector<double>& angles) const {
    return turn(std::vector<BodyDescription>{post}, angles);
  }
  CycleResult turn(const std::vector<BodyDescription>& posts, const std::vector<double>& angles) const {
    const std::shared_ptr<const Scene> scene = sceneOf(posts);
    return checkMotion(scene, {}, motionOf(*scene, angles));
  }

  std::shared_ptr<const Scene> sceneOf(const std::vector<BodyDescription>& posts) const {
    std::vector<std::string> warnings;
    SceneDescription description = describeRobot(robot_, {}, {}, {}, warnings);
    description.bodies.insert(description.bodies.end(), posts.begin(), posts.end());
    const BodyOptions options = optionsFor({4e-3, {}});
    return std::make_shared<const Scene>(
        buildScene(description, planScene(description, planOptions(options)), options));
  }

  PlannedMotion motionOf(const Scene& scene, const std::vector<double>& angles, double tolerance = 1e-4,
                         double start = 0.0) const {
    RobotTrajectory trajectory;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      trajectory.times.push_back(start + double(i));
      trajectory.states.emplace_back().positions["turn"] = angles[i];
    }
    MotionSampling sampling;
    sampling.tolerance = tolerance;
    return planAlong(robot_, completePlan(robot_, trajectory, {}, {}), bodiesOf(scene, robot_), {}, sampling);
  }

  const RobotModel robot_{kRod};
};

TEST_F(CheckMotionTest, TimesCountFromTheFirstPoint) {
  const std::shared_ptr<const Scene> scene = sceneOf({post("base", 2.0)});
  const auto motion = [&](std::size_t, double tolerance) { return motionOf(*scene, {0.0, 4.0}, tolerance, 5.0); };
  const PlannedMotion planned = motion(0, 1e-4);
  EXPECT_EQ(planned.samples, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(planned.waypoints.front(), 0.0);
  EXPECT_EQ(planned.waypoints.back(), 1.0);
  EXPECT_NEAR(checkMotion(scene, {}, planned).pairs[0].intervals.at(0).enter, 0.5, 0.02);
  EXPECT_LE(checkMotions(scene, {}, 1, motion).at(0).time, 0.51);
}

TEST_F(CheckMotionTest, FindsWhatLiesBetweenTheWaypoints) {
  // The rod's side touches the post when it still has asin((0.01 + 0.03) / 0.9) to rotate.
  const CycleResult result = turn(post("base", 2.0), {0.0, 4.0});
  EXPECT_EQ(result.verdict, Verdict::kContact);
  ASSERT_EQ(result.pairs.size(), 1u);
  ASSERT_EQ(result.pairs[0].intervals.size(), 1u);
  const double half_angle = std::asin(0.04 / 0.9);
  EXPECT_NEAR(result.pairs[0].intervals[0].enter, (2.0 - half_angle) / 4.0, 4e-3);
  EXPECT_NEAR(result.pairs[0].intervals[0].exit, (2.0 + half_angle) / 4.0, 4e-3);
  EXPECT_EQ(turn(post("base", 2.0), {0.0, 1.9}).verdict, Verdict::kClear);
}

TEST_F(CheckMotionTest, LongMotionsArePutTogetherOfPieces) {
  std::vector<double> angles;
  for (int i = 0; i <= 100; ++i) angles.push_back(0.05 * i);
  const CycleResult result = turn(post("base", 4.0), angles);
  EXPECT_EQ(result.verdict, Verdict::kContact);
  ASSERT_EQ(result.pairs[0].intervals.size(), 1u);
  EXPECT_NEAR(result.pairs[0].intervals[0].enter, (4.0 - std::asin(0.04 / 0.9)) / 0.05, 0.05);
}

TEST_F(CheckMotionTest, WhatALinkHoldsMovesWithIt) {
  BodyDescription wall = post("base", 1.5), tool = post("rod", 0.0);
  wall.name = "wall";
  wall.X_frame_B = wall.X_frame_B * Eigen::Translation3d(0.4, 0.0, 0.0);  // beyond the rod's end
  tool.X_frame_B = Eigen::Translation3d(1.3, 0.0, 0.0);
  tool.is_world = false;
  const CycleResult result = turn({wall, tool}, {1.0, 2.0});
  EXPECT_EQ(result.verdict, Verdict::kContact);
  const auto touching = std::find_if(result.pairs.begin(), result.pairs.end(),
                                     [](const PairResult& pair) { return pair.verdict == Verdict::kContact; });
  ASSERT_NE(touching, result.pairs.end());
  ASSERT_EQ(touching->intervals.size(), 1u);
  EXPECT_NEAR(touching->intervals[0].enter, 0.5 - 2.0 * std::asin(0.03 / 1.3), 4e-3);
  EXPECT_EQ(turn({wall, tool}, {1.0, 1.4}).verdict, Verdict::kClear);
}

TEST_F(CheckMotionTest, BodiesInUnknownFramesAreNotChecked) {
  const CycleResult result = turn(post("map", 2.0), {0.0, 1.0});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  ASSERT_EQ(result.pairs.size(), 1u);
  EXPECT_NE(result.pairs[0].reason.find("the robot has no link \"map\", the frame of post"), std::string::npos)
      << result.pairs[0].reason;
}

TEST(PlanThrough, KeepsWhatIsNotKnownOfTheMotion) {
  const auto scene = std::make_shared<const Scene>(makeScene(
      {prepareBody("a", Box{{0.1, 0.1, 0.1}}, {5e-3, {}}), prepareBody("b", Box{{0.1, 0.1, 0.1}}, {5e-3, {}})}));
  const Isometry3d still = Isometry3d::Identity(), apart(Eigen::Translation3d(0.3, 0.0, 0.0));
  CycleMotion motion;
  motion.times = {0.0, 1.0};
  motion.X_WB = {{still, still}, {apart, apart}};
  const auto verdict = [&](const CycleMotion& motion) {
    const PlannedMotion plan = planThrough(motion, {true, true}, {});
    return checkMotion(scene, {}, plan).verdict;
  };
  EXPECT_EQ(verdict(motion), Verdict::kClear);
  CycleMotion unsure = motion;
  unsure.motion_error = {0.2, 0.0};
  EXPECT_EQ(verdict(unsure), Verdict::kUncertain);
  CycleMotion lost = motion;
  lost.missing = {"gone", ""};
  lost.X_WB[0].clear();
  EXPECT_EQ(verdict(lost), Verdict::kNotChecked);
}

TEST(PlanThrough, RefusesWhatDoesNotFit) {
  const Isometry3d still = Isometry3d::Identity();
  CycleMotion good;
  good.times = {0.0, 1.0};
  good.X_WB = {{still, still}, {still, still}};
  UnreachablePair far;
  far.body_a = 0;
  far.body_b = 1;
  far.ball_a = far.ball_b = {Vector3d::Zero(), 0.1};
  EXPECT_NO_THROW(planThrough(good, {true, true}, {far}));
  EXPECT_THROW(planThrough(good, {}, {far}), std::invalid_argument);
  const auto expectRefused = [](CycleMotion motion, const std::function<void(CycleMotion&)>& spoil) {
    spoil(motion);
    EXPECT_THROW(planThrough(motion, {true, true}, {}), std::invalid_argument);
  };
  expectRefused(good, [](CycleMotion& motion) { motion.X_WB[1].push_back(motion.X_WB[1][0]); });
  expectRefused(good, [](CycleMotion& motion) { motion.times = {5.0, 6.0}; });
  expectRefused(good, [](CycleMotion& motion) { motion.times = {0.0}; });
  expectRefused(good, [](CycleMotion& motion) { motion.spans = {{0, 0}}; });
  expectRefused(good, [](CycleMotion& motion) { motion.missing = {"one"}; });
  expectRefused(good,
                [](CycleMotion& motion) { motion.X_WB[0][1] = Eigen::AngleAxisd(std::acos(-1.0), Vector3d::UnitZ()); });
}

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

}  // namespace
}  // namespace sdf_ccd
