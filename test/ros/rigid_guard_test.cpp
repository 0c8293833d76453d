// The assumption behind pairs that are left out because the URDF joins them rigidly.

#include <gtest/gtest.h>

#include <set>

#include "ros/messages/conversions.h"
#include "ros/monitor/cycle_messages.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::rigid_guard_test {

using test::message;
using test::stampedTransform;

const std::string kBall = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";

MonitorParameters parametersOf(const std::string& urdf) {
  MonitorParameters parameters = parseParameters({}, "~");
  parameters.urdf = urdf;
  parameters.scene.cache_directory.clear();
  return parameters;
}

WorldObject box(const std::string& name, const std::string& frame, const Vector3d& half = Vector3d::Constant(0.1),
                const Vector3d& at = Vector3d::Zero()) {
  WorldObject object;
  object.name = name;
  object.frame = frame;
  object.shapes = {{Primitive(Box::fromSize(2.0 * half))}};
  object.X_frame_B.translation() = at;
  return object;
}

DescribedScene describe(const MonitorParameters& parameters) {
  return describeScene(parameters, [](const std::string&) { return Resource(); });
}

std::unique_ptr<MonitorLoop> loopOf(DescribedScene described, const MonitorParameters& parameters) {
  const ScenePlan plan = planScene(described.scene, planOptions(parameters.scene));
  return std::make_unique<MonitorLoop>(buildDescribed(described, plan, parameters.scene, {}), described, parameters);
}

/// In the URDF the base stands in the world for good. An arm turns on it; its tool is checked against a wall. A table
/// stands in the world, and a floor, above which the arm turns.
class FixedBaseTest : public ::testing::Test {
 protected:
  FixedBaseTest() { prepare({}); }

  void prepare(const std::vector<PairRule>& allowed) {
    MonitorParameters parameters = parametersOf(
        "<robot name='r'><link name='world'/><link name='base'>" + kBall + "</link><link name='arm'>" + kBall +
        "</link><link name='tool'>" + kBall +
        "</link><joint name='stands' type='fixed'><parent link='world'/><child link='base'/></joint>"
        "<joint name='turns' type='continuous'><parent link='base'/><child link='arm'/><origin xyz='0 0 0.5'/><axis "
        "xyz='0 0 1'/></joint><joint name='holds' type='fixed'><parent link='arm'/><child link='tool'/><origin "
        "xyz='0.5 0 0'/></joint></robot>");
    parameters.world = {box("wall", "elsewhere"), box("table", "world", {0.1, 0.1, 1.0}, {3.0, 0.0, 0.0}),
                        box("floor", "world", {5.0, 5.0, 0.1}, {0.0, 0.0, -2.0})};
    parameters.pairs.allowed = allowed;
    parameters.pairs.allowed.insert(parameters.pairs.allowed.end(), {{"wall", "base"}, {"wall", "arm"}});
    described_ = describe(parameters);
    loop_ = loopOf(described_, parameters);
    loop_->history().add(
        message({stampedTransform("world", "elsewhere", time_, 50.0), stampedTransform("arm", "tool", time_, 0.5)}),
        true);
  }

  /// What is not checked, as "base - table: reason", if tf has the base at x. Contacts are kept in contacts_.
  std::set<std::string> uncheckedWithBaseAt(double x) {
    TfTracker::Step step = TfTracker::Step::kWaiting;
    for (int i = 0; i < 5 && step != TfTracker::Step::kCycle; ++i) {
      loop_->history().add(message({stampedTransform("world", "base", time_, x),
                                    stampedTransform("base", "arm", ros::Time(time_), Quaterniond::Identity(),
                                                     Vector3d(0.0, 0.0, 0.5))}),
                           false);
      step = loop_->step(ros::Time(time_), {});
      time_ += 0.05;
    }
    std::set<std::string> unchecked;
    contacts_.clear();
    for (const PairContact& pair : toContactArray(*loop_).pairs) {
      const std::string name = pair.body_a + " - " + pair.body_b;
      if (pair.verdict == numberOf(Verdict::kNotChecked)) unchecked.insert(name + ": " + pair.reason);
      if (pair.verdict == numberOf(Verdict::kContact)) contacts_.insert(name);
    }
    return unchecked;
  }

  std::set<std::string> contacts_;
  DescribedScene described_;
  std::unique_ptr<MonitorLoop> loop_;
  double time_ = 100.0;
};

TEST_F(FixedBaseTest, WhatTheUrdfFixesAndTfDoesNotMoveIsClear) {
  ASSERT_EQ(loop_->scene().pairs.size(), 6u) << "tool and wall, base and tool, arm and tool with table and floor";
  EXPECT_EQ(uncheckedWithBaseAt(0.0), std::set<std::string>());
  EXPECT_EQ(uncheckedWithBaseAt(5e-4), std::set<std::string>()) << "calibrated";
}

/// tf takes the base to the table.
TEST_F(FixedBaseTest, WhatTfMovesIsNotChecked) {
  uncheckedWithBaseAt(0.0);
  const std::string moved =
      ": rigidly joined in the URDF, but not in tf: do the URDF and tf belong to the same robot? If these may touch, "
      "name them in allowed_pairs";
  EXPECT_EQ(uncheckedWithBaseAt(2.6), (std::set<std::string>{"base - table" + moved, "base - floor" + moved}));
  EXPECT_EQ(contacts_, std::set<std::string>{"tool - table"});
  uncheckedWithBaseAt(0.0);
  EXPECT_EQ(uncheckedWithBaseAt(0.0), std::set<std::string>()) << "back again";
}

/// From one transform to the next, tf takes the arm through the table.
TEST_F(FixedBaseTest, WhatPassesBetweenTwoTransformsIsAContact) {
  prepare({{"base", "*"}});
  uncheckedWithBaseAt(0.0);
  EXPECT_EQ(uncheckedWithBaseAt(6.0), std::set<std::string>());
  EXPECT_EQ(contacts_, (std::set<std::string>{"arm - table", "tool - table"}));
  EXPECT_EQ(uncheckedWithBaseAt(12.0), std::set<std::string>());
  EXPECT_EQ(contacts_, std::set<std::string>()) << "away from it";
}

TEST_F(FixedBaseTest, WhatIsAllowedToTouchIsNotWatched) {
  prepare({{"table", "*"}, {"floor", "base"}});
  uncheckedWithBaseAt(0.0);
  EXPECT_EQ(uncheckedWithBaseAt(2.6), std::set<std::string>());
}

/// Three links are fixed on one that turns; tf moves the middle one, which may touch the first.
TEST(RigidGuard, WatchesAGroupAlsoWhereSomeOfItMayTouch) {
  std::string urdf = "<robot name='r'><link name='base'>" + kBall +
                     "</link><link name='turn'/><joint name='turns' type='continuous'><parent link='base'/><child "
                     "link='turn'/><origin xyz='9 0 0'/><axis xyz='0 0 1'/></joint>";
  for (const std::string number : {"0", "1", "2"})
    urdf += "<link name='l" + number + "'>" + kBall + "</link><joint name='j" + number +
            "' type='fixed'><parent link='turn'/><child link='l" + number + "'/><origin xyz='" + number +
            " 0 0'/></joint>";
  MonitorParameters parameters = parametersOf(urdf + "</robot>");
  parameters.pairs.allowed = {{"l0", "l1"}};
  parameters.world.push_back(box("wall", "elsewhere"));
  const std::unique_ptr<MonitorLoop> loop = loopOf(describe(parameters), parameters);
  std::set<std::string> unchecked;
  for (int i = 0; i < 20; ++i) {
    const double time = 100.0 + 0.05 * i, moved = i < 10 ? 0.0 : 0.1 * (i - 9);
    loop->history().add(
        message({stampedTransform("base", "elsewhere", time, 50.0), stampedTransform("base", "turn", time, 9.0),
                 stampedTransform("turn", "l0", time, 0.0), stampedTransform("turn", "l1", time, 1.0 + moved),
                 stampedTransform("turn", "l2", time, 2.0)}),
        false);
    if (loop->step(ros::Time(time), {}) != TfTracker::Step::kCycle) continue;
    unchecked.clear();
    for (const PairContact& pair : toContactArray(*loop).pairs) unchecked.insert(pair.body_a + " - " + pair.body_b);
    if (i < 10) {
      EXPECT_EQ(unchecked, std::set<std::string>());
    }
  }
  EXPECT_EQ(unchecked, std::set<std::string>({"l1 - l2"}));
}

/// A mobile robot with a load in its base's frame, whose arm's transforms come later than is waited for: the poses of
/// the cycle are then not all those of tf.
TEST(RigidGuard, LateFramesOfOthersMoveNothing) {
  MonitorParameters parameters =
      parametersOf("<robot name='r'><link name='base'>" + kBall + "</link><link name='arm'>" + kBall +
                   "</link><joint name='turns' type='continuous'><parent link='base'/><child link='arm'/><origin "
                   "xyz='0 0 0.3'/><axis xyz='0 0 1'/></joint></robot>");
  parameters.fixed_frame = "map";
  const Vector3d half = Vector3d::Constant(0.1);
  parameters.world = {box("load", "base", half, {0.4, 0.0, 0.3}), box("table", "map", half, {5.0, 0.0, 0.3})};
  const std::unique_ptr<MonitorLoop> loop = loopOf(describe(parameters), parameters);
  int cycles = 0, late = 0;
  for (int i = 0; i < 240; ++i) {
    const double seconds = i / 60.0, time = 100.0 + seconds;
    if (i % 3 == 0)
      loop->history().add(message({stampedTransform("map", "base", time, 0.5 * seconds, 0.5 * seconds)}), false);
    loop->history().add(message({stampedTransform("base", "arm", ros::Time(time - 0.6), Quaterniond::Identity(),
                                                  Vector3d(0.0, 0.0, 0.3))}),
                        false);
    if (i % 2 != 0 || loop->step(ros::Time(time), {}) != TfTracker::Step::kCycle) continue;
    ++cycles;
    for (const PairContact& pair : toContactArray(*loop).pairs) {
      late += pair.reason.find("late") != std::string::npos;
      EXPECT_EQ(pair.reason.find("URDF"), std::string::npos)
          << i << ": " << pair.body_a << " - " << pair.body_b << ": " << pair.reason;
    }
  }
  EXPECT_GT(cycles, 20);
  EXPECT_EQ(late, 0) << "they are named as bodies";
}

/// An arm turns in front of a wall. Its tool is fixed on it, but comes from another publisher.
class LateTool {
 public:
  LateTool() {
    MonitorParameters parameters = parametersOf(
        "<robot name='r'><link name='base'>" + kBall + "</link><link name='arm'>" + kBall +
        "</link><link name='tool'>" + kBall +
        "</link><joint name='turns' type='continuous'><parent link='base'/><child link='arm'/><origin xyz='0 0 "
        "0.5'/><axis xyz='0 0 1'/></joint><joint name='holds' type='fixed'><parent link='arm'/><child "
        "link='tool'/><origin xyz='0.5 0 0'/></joint></robot>");
    parameters.world = {box("wall", "elsewhere")};
    parameters.pairs.allowed = {{"wall", "tool"}};
    loop_ = loopOf(describe(parameters), parameters);
    loop_->history().add(message({stampedTransform("base", "elsewhere", 100.0, 50.0)}), true);
  }

  /// What is not checked in three seconds, where the tool moves into the arm from the second one on.
  std::set<std::string> uncheckedWithLag(int lag, double moves) {
    std::set<std::string> unchecked;
    for (int i = 0; i < 150; ++i) {
      const auto timeOf = [](int k) { return ros::Time(100.0) + ros::Duration(0.02 * k); };
      const auto turned = [](int k) { return Quaterniond(Eigen::AngleAxisd(0.01 * k, Vector3d::UnitZ())); };
      loop_->history().add(message({stampedTransform("base", "arm", timeOf(i), turned(i), Vector3d(0.0, 0.0, 0.5))}),
                           false);
      const int k = i - lag;
      const double x = 0.5 - std::min(std::max(0.02 * k - 1.0, 0.0) * moves, 0.3);
      if (k >= 0) loop_->history().add(message({stampedTransform("arm", "tool", timeOf(k).toSec(), x)}), false);
      if (loop_->step(timeOf(i), {}) != TfTracker::Step::kCycle || i < lag + 10) continue;
      const ContactArray said = toContactArray(*loop_);
      for (const PairContact& pair : said.pairs)
        unchecked.insert(pair.body_a + " - " + pair.body_b + ": " + pair.reason.substr(0, pair.reason.find(" the")));
      for (const UncheckedBody& body : said.unchecked) unchecked.insert(body.reason.substr(0, body.reason.find(" by")));
    }
    return unchecked;
  }

 private:
  std::unique_ptr<MonitorLoop> loop_;
};

TEST(LateTool, IsWatchedWhenItIsKnown) {
  for (const int lag : {0, 1, 5, 20}) {
    EXPECT_EQ(LateTool().uncheckedWithLag(lag, 0.0), std::set<std::string>()) << lag;
    EXPECT_EQ(LateTool().uncheckedWithLag(lag, 1.0), std::set<std::string>{"arm - tool: rigidly joined in"}) << lag;
  }
}

/// Nothing waits for it, and no checked pair tells that it is late.
TEST(LateTool, IsNotCheckedIfItIsTooLate) {
  EXPECT_EQ(LateTool().uncheckedWithLag(30, 0.0), std::set<std::string>{"tool is late"});
}

}  // namespace sdf_ccd::rigid_guard_test
