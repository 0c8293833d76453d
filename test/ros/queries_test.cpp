#include "ros/monitor/queries.h"
#include "ros/messages/conversions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "cancel_moments.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd::queries_test {

using namespace test;

constexpr double kStart = 100.0;  // [s]

/// A ball on a floating joint in front of a wall, with thousands of surface points.
class QueriesTest : public ::testing::Test {
 protected:
  QueriesTest() {
    MonitorParameters& parameters = parameters_;
    parameters.urdf = R"(<robot name="ball"><link name="base"/>
      <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
      <joint name="free" type="floating"><parent link="base"/><child link="ball"/></joint></robot>)";
    parameters.scene.cache_directory.clear();
    parameters.scene.shell.spacing = 0.004;
    WorldObject wall;
    wall.name = "wall";
    wall.shapes = {{Primitive(Box::fromSize({0.6, 0.6, 0.6}))}};
    parameters.world.push_back(wall);
    described_ = describeScene(parameters, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    scene_ = buildDescribed(described_, plan, parameters.scene, {});
    loop_ = std::make_unique<MonitorLoop>(scene_, described_, parameters);
    loop_->history().add(message({stampedTransform("base", "ball", kStart, 1.0)}), false);
    limits_.seconds = 0.005;
    queries_ = std::make_unique<Queries>(loop_->world(), described_, parameters, loop_->history(), limits_);
  }

  MonitorParameters parameters_ = parseParameters({}, "~");
  DescribedScene described_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<MonitorLoop> loop_;
  QueryLimits limits_;
  std::unique_ptr<Queries> queries_;
};

/// The ball rotates in the wall, in as few steps as are checked in one piece.
QueryMotion::Request heavyRequest() {
  QueryMotion::Request request;
  request.motion.link_trajectory.link_names = {"ball"};
  for (int i = 0; i < 16; ++i) {
    LinkTrajectoryPoint poses;
    poses.time_from_start = ros::Duration(0.1 * i);
    poses.poses.resize(1);
    poses.poses[0].position.x = 0.35;
    poses.poses[0].orientation.z = std::sin(i % 2);
    poses.poses[0].orientation.w = std::cos(i % 2);
    request.motion.link_trajectory.points.push_back(poses);
  }
  return request;
}

TEST_F(QueriesTest, OnePairTakesNoLongerThanItMay) {
  QueryMotion::Response response;
  const double took = secondsOf([&] { queries_->answer(heavyRequest(), response); });
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.verdict, numberOf(Verdict::kNotChecked));
  EXPECT_NE(response.message.find("takes more than 0.005 s"), std::string::npos) << response.message;
  EXPECT_GE(took, limits_.seconds);
  EXPECT_LT(took, limits_.seconds + 0.1 * slowness());
}

TEST_F(QueriesTest, EndsSoonWithItsCaller) {
  std::atomic<bool> asked{true};
  const CancelScope scope(asked);
  QueryMotion::Response response;
  EXPECT_THROW(queries_->answer(heavyRequest(), response), Cancelled);
}

/// The ball is a shell against the wall's field, and has no field itself.
TEST_F(QueriesTest, DistancesAreKnownOfBodiesWithoutAField) {
  Queries queries(loop_->world(), described_, parameters_, loop_->history(), {});
  QueryPoints::Request request;
  request.points.resize(1);
  request.points[0].x = 0.93;  // in the ball
  QueryPoints::Response response;
  queries.answer(request, response);
  ASSERT_TRUE(response.success) << response.message;
  ASSERT_EQ(response.points.size(), 1u);
  EXPECT_EQ(response.points[0].body, "ball");
  EXPECT_NEAR(response.points[0].distance, -0.03, 1e-9);
  EXPECT_NEAR(response.points[0].gradient.x, -1.0, 1e-9);
  EXPECT_EQ(response.message, "");
}

/// From x = 1 m the ball moves into the wall, or short of it, in more motions than are checked in one piece.
TEST_F(QueriesTest, PairsOfManyMotionsAreListedWithTheirFirstContact) {
  QueryMotions::Request request;
  request.list_pairs = true;
  request.motions.resize(100);
  for (std::size_t i = 0; i < request.motions.size(); ++i) {
    trajectory_msgs::MultiDOFJointTrajectory& poses = request.motions[i].multi_dof_joint_trajectory;
    poses.joint_names = {"free"};
    for (const double x : {1.0, i % 2 == 0 ? 0.0 : 0.5}) {
      trajectory_msgs::MultiDOFJointTrajectoryPoint point;
      point.time_from_start = ros::Duration(double(poses.points.size()));
      point.transforms.resize(1);
      point.transforms[0].translation.x = x;
      point.transforms[0].rotation.w = 1.0;
      poses.points.push_back(point);
    }
  }
  const auto answer = [&](const QueryLimits& limits) {
    Queries queries(loop_->world(), described_, parameters_, loop_->history(), limits);
    QueryMotions::Response response;
    queries.answer(request, response);
    return response;
  };
  QueryMotions::Response response = answer({});
  ASSERT_TRUE(response.success) << response.message;
  ASSERT_EQ(response.motions.size(), 100U);
  for (std::size_t k = 0; k < 100; k += 2) {
    const CheckedMotion &touching = response.motions[k], &clear = response.motions[k + 1];
    EXPECT_EQ(touching.verdict, numberOf(Verdict::kContact));
    ASSERT_EQ(touching.pairs.size(), 1u);
    EXPECT_EQ(touching.pairs[0].verdict, numberOf(Verdict::kContact));
    EXPECT_EQ(touching.pairs[0].body_a + " " + touching.pairs[0].body_b, "ball wall");
    EXPECT_NEAR(touching.pairs[0].time.toSec(), 0.6, 1e-3) << "its surface, 0.1 m ahead, comes to x = 0.3 m";
    EXPECT_EQ(touching.time, touching.pairs[0].time);
    EXPECT_EQ(clear.verdict, numberOf(Verdict::kClear));
    EXPECT_TRUE(clear.pairs.empty() && clear.body_a.empty());
    EXPECT_EQ(clear.time, ros::Duration(-1.0));
  }
  QueryLimits few;
  few.pairs = 49;
  response = answer(few);
  EXPECT_FALSE(response.success);
  EXPECT_NE(response.message.find("listed pairs: at most 49 are allowed"), std::string::npos) << response.message;
  request.list_pairs = false;
  response = answer(few);
  ASSERT_EQ(response.motions.size(), 100U);
  EXPECT_EQ(response.motions[0].body_a + " " + response.motions[0].body_b, "ball wall");
  EXPECT_TRUE(response.motions[0].pairs.empty());
}

/// In the URDF the base is fixed in the world; an arm and a leaf turn on it, which are checked. tf has the base
/// elsewhere, by a post.
class MovedBaseTest : public ::testing::Test {
 protected:
  MovedBaseTest() {
    const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
    const auto turning = [&](const std::string& name, const std::string& z) {
      return "<link name='" + name + "'>" + "<collision><origin xyz='0.5 0 0'/><geometry><sphere radius='0.1'/>" +
             "</geometry></collision></link><joint name='j_" + name + "' type='continuous'><parent link='base'/>" +
             "<child link='" + name + "'/><origin xyz='0 0 " + z + "'/><axis xyz='0 0 1'/></joint>";
    };
    MonitorParameters parameters = parseParameters({}, "~");
    parameters.overlapping_pairs = OverlapRule::Kind::kCheck;  // arm and leaf are inside each other at rest
    parameters.urdf = "<robot name='r'><link name='world'/><link name='base'>" + ball +
                      "</link><joint name='stands' type='fixed'><parent link='world'/><child link='base'/></joint>" +
                      turning("arm", "0.4") + turning("leaf", "0.5") + "</robot>";
    parameters.scene.cache_directory.clear();
    WorldObject post;
    post.name = "post";
    post.X_frame_B.translation() = Vector3d(3.5, 0.0, 0.4);
    post.shapes = {{Primitive(Sphere{0.1})}};
    parameters.world.push_back(post);
    described_ = describeScene(parameters, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    loop_ =
        std::make_unique<MonitorLoop>(buildDescribed(described_, plan, parameters.scene, {}), described_, parameters);
    queries_ = std::make_unique<Queries>(loop_->world(), described_, parameters, loop_->history(), QueryLimits());
  }

  void send(double base) {
    const auto turned = [](double angle) { return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ())); };
    time_ += 0.1;
    loop_->history().add(message({stampedTransform("world", "base", time_, base),
                                  stampedTransform("base", "arm", ros::Time(time_), turned(1.5), {0.0, 0.0, 0.4}),
                                  stampedTransform("base", "leaf", ros::Time(time_), turned(-2.5), {0.0, 0.0, 0.5})}),
                         false);
  }

  /// "body - body: reason" of the pairs that are not checked while the arm turns; without a reason, of contacts.
  std::vector<std::string> uncheckedWithArm(double from, double to) {
    QueryMotion::Request request;
    request.motion.joint_trajectory.joint_names = {"j_arm"};
    for (const double angle : {from, to}) {
      request.motion.joint_trajectory.points.emplace_back();
      request.motion.joint_trajectory.points.back().positions = {angle};
      request.motion.joint_trajectory.points.back().time_from_start =
          ros::Duration(request.motion.joint_trajectory.points.size());
    }
    QueryMotions::Request several;
    several.motions.resize(1);
    several.motions[0] = request.motion;
    QueryMotions::Response verdicts;
    queries_->answer(several, verdicts);
    const std::vector<std::string> unchecked = uncheckedOf(request);
    const bool is_clear = !verdicts.motions.empty() && verdicts.motions[0].verdict == numberOf(Verdict::kClear);
    EXPECT_EQ(is_clear, unchecked.empty());
    for (const std::string& pair : unchecked)
      EXPECT_EQ(verdicts.message.find(pair) == std::string::npos, pair.back() == ' ') << verdicts.message;
    return unchecked;
  }

  std::vector<std::string> uncheckedOf(const QueryMotion::Request& request) {
    QueryMotion::Response response;
    queries_->answer(request, response);
    EXPECT_TRUE(response.success) << response.message;
    EXPECT_GT(response.checked, 0);
    std::vector<std::string> unchecked;
    for (const PairContact& pair : response.pairs)
      unchecked.push_back(pair.body_a + " - " + pair.body_b + ": " + pair.reason.substr(0, pair.reason.find(':')));
    const auto isContact = [](const std::string& pair) { return pair.back() == ' '; };
    EXPECT_EQ(response.verdict, unchecked.empty() ? numberOf(Verdict::kClear)
                                : std::any_of(unchecked.begin(), unchecked.end(), isContact)
                                    ? numberOf(Verdict::kContact)
                                    : numberOf(Verdict::kNotChecked));
    return unchecked;
  }

  DescribedScene described_;
  std::unique_ptr<MonitorLoop> loop_;
  std::unique_ptr<Queries> queries_;
  double time_ = kStart;
};

TEST_F(MovedBaseTest, APlanKnowsWhatTheUrdfDoesNotHave) {
  using Pairs = std::vector<std::string>;
  const std::string joined = "base - post: rigidly joined in the scene, but not certainly in this motion";
  send(0.0);
  EXPECT_EQ(uncheckedWithArm(1.0, 1.5), Pairs());
  send(3.0);
  EXPECT_EQ(uncheckedWithArm(1.0, 1.5), Pairs({joined})) << "beside the post";
  EXPECT_EQ(uncheckedWithArm(1.0, -1.0), Pairs({"arm - post: ", joined})) << "through it, between two points";
}

TEST_F(MovedBaseTest, PosesOfAnotherLinkKnowIt) {
  QueryMotion::Request request;
  request.motion.link_trajectory.link_names = {"leaf"};
  for (int i = 0; i < 2; ++i) {
    request.motion.link_trajectory.points.emplace_back();
    request.motion.link_trajectory.points.back().time_from_start = ros::Duration(i);
    request.motion.link_trajectory.points.back().poses.resize(1);
    request.motion.link_trajectory.points.back().poses[0].position.z = 5.0 + i;
    request.motion.link_trajectory.points.back().poses[0].orientation.w = 1.0;
  }
  send(0.0);
  EXPECT_EQ(uncheckedOf(request), std::vector<std::string>());
  send(3.0);
  EXPECT_EQ(uncheckedOf(request),
            std::vector<std::string>{"base - post: rigidly joined in the scene, but not certainly in this motion"});
}

}  // namespace sdf_ccd::queries_test
