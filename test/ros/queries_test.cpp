#include "ros/monitor/queries.h"

#include <gtest/gtest.h>

#include "cancel_moments.h"
#include "ros/monitor/monitor_loop.h"
#include "ros/tf_messages.h"

namespace sdf_ccd {
namespace {

using namespace test;

constexpr double kStart = 100.0;  // [s]

/// A ball on a floating joint in front of a wall, with thousands of surface points.
class QueriesTest : public ::testing::Test {
 protected:
  QueriesTest() {
    MonitorParameters parameters = parseParameters({}, "~");
    parameters.urdf = R"(<robot name="ball"><link name="base"/>
      <link name="ball"><collision><geometry><sphere radius="0.1"/></geometry></collision></link>
      <joint name="free" type="floating"><parent link="base"/><child link="ball"/></joint></robot>)";
    parameters.scene.cache_directory.clear();
    parameters.scene.shell.spacing = 0.004;
    WorldObject wall;
    wall.name = "wall";
    wall.shapes = {{Primitive(Box{Vector3d(0.3, 0.3, 0.3)})}};
    parameters.world.push_back(wall);
    described_ = describeScene(parameters, [](const std::string&) { return Resource(); });
    const ScenePlan plan = planScene(described_.scene, planOptions(parameters.scene));
    scene_ = buildDescribed(described_, plan, parameters.scene, {});
    loop_ = std::make_unique<MonitorLoop>(scene_, described_, parameters);
    loop_->history().add(message({stampedTransform("base", "ball", kStart, 1.0)}), false);
    limits_.seconds = 0.005;
    queries_ = std::make_unique<Queries>(loop_->world(), described_, parameters, loop_->history(), limits_);
  }

  DescribedScene described_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<MonitorLoop> loop_;
  QueryLimits limits_;
  std::unique_ptr<Queries> queries_;
};

/// The ball rotates in the wall, in as few steps as are checked in one piece.
QueryMotion::Request heavyRequest() {
  QueryMotion::Request request;
  request.links = {"ball"};
  for (int i = 0; i < 16; ++i) {
    LinkPoses poses;
    poses.time_from_start = ros::Duration(0.1 * i);
    poses.poses.resize(1);
    poses.poses[0].position.x = 0.35;
    poses.poses[0].orientation.z = std::sin(i % 2);
    poses.poses[0].orientation.w = std::cos(i % 2);
    request.poses.push_back(poses);
  }
  return request;
}

TEST_F(QueriesTest, OnePairTakesNoLongerThanItMay) {
  QueryMotion::Response response;
  const double took = secondsOf([&] { queries_->answer(heavyRequest(), response); });
  EXPECT_FALSE(response.success);
  EXPECT_EQ(response.verdict, QueryMotion::Response::NOT_CHECKED);
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

}  // namespace
}  // namespace sdf_ccd
