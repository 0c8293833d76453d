#include "ros/planned_motion.h"

#include <gtest/gtest.h>

namespace sdf_ccd {
namespace {

const char* const kUrdf = R"(<robot name="pendulum">
  <link name="base"/>
  <link name="rod"/>
  <joint name="swing" type="revolute">
    <parent link="base"/><child link="rod"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
</robot>)";

class PlannedMotionTest : public ::testing::Test {
 protected:
  PlannedMotionTest() {
    Body rod, wall;
    rod.name = rod.frame = "rod";
    wall.name = "wall";
    wall.is_world = true;
    for (Body* body : {&rod, &wall}) body->X_frame_B.setIdentity();
    scene_.bodies = {rod, wall};
    now_.X_WR = Eigen::Translation3d(2.0, 0.0, 0.0);
    now_.X_WB = {Isometry3d::Identity(), Isometry3d(Eigen::Translation3d(0.0, 5.0, 0.0))};
    now_.missing = {"no transform", ""};
  }

  static QueryMotion::Request swing(std::vector<double> positions) {
    QueryMotion::Request request;
    request.trajectory.joint_names = {"swing"};
    for (std::size_t i = 0; i < positions.size(); ++i) {
      trajectory_msgs::JointTrajectoryPoint point;
      point.positions = {positions[i]};
      point.time_from_start = ros::Duration(1.0 + i);
      request.trajectory.points.push_back(point);
    }
    return request;
  }

  CycleMotion motion(const QueryMotion::Request& request) {
    return toCycleMotion(request, {scene_, robot_, now_, MotionSampling()}, samples_);
  }

  std::string refusal(const QueryMotion::Request& request) {
    try {
      motion(request);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "not refused";
  }

  RobotModel robot_{kUrdf};
  Scene scene_;
  CurrentPoses now_;
  std::vector<double> samples_;
};

TEST_F(PlannedMotionTest, TrajectoryMovesLinksWhereverTfHasThem) {
  const CycleMotion result = motion(swing({0.0, M_PI_2, 0.0}));
  EXPECT_EQ(samples_, (std::vector<double>{0.0, 1.0, 2.0}));
  EXPECT_EQ(result.times, (std::vector<double>{0.0, 0.5, 1.0, 1.5, 2.0}));  // so that no link turns by more than 1 rad
  EXPECT_EQ(result.missing[0], "");
  EXPECT_LT((result.X_WB[0][2] * Vector3d(0.0, 0.0, -1.0) - Vector3d(1.0, 0.0, 1.0)).norm(), 1e-12);
  EXPECT_EQ(result.X_WB[1][2].translation(), Vector3d(0.0, 5.0, 0.0));
}

TEST_F(PlannedMotionTest, WholeRevolutionsAreNotTakenForRest) {
  for (const int revolutions : {1, 2, 4, 64}) {
    const CycleMotion result = motion(swing({0.5, 0.5 + revolutions * 2.0 * M_PI}));
    EXPECT_EQ(samples_, (std::vector<double>{0.0, 1.0}));
    double turned = 0.0;
    for (std::size_t k = 0; k + 1 < result.times.size(); ++k) {
      const ScrewMotion screw(result.X_WB[0][k], result.X_WB[0][k + 1]);
      EXPECT_LE(screw.angle(), 1.0 + 1e-9);
      turned += screw.angle();
    }
    EXPECT_NEAR(turned, revolutions * 2.0 * M_PI, 1e-6);
  }
  EXPECT_NE(refusal(swing({0.0, 1e9})).find("turns a link by 1e+09 rad up to point 1"), std::string::npos);
  EXPECT_NE(refusal(swing({0.0, 1e300})).find("1e+300"), std::string::npos);
}

TEST_F(PlannedMotionTest, UnknownRootMakesAllLinksMissing) {
  now_.root_missing = "no map";
  EXPECT_EQ(motion(swing({0.0, 1.0})).missing[0], "no map");
}

TEST_F(PlannedMotionTest, LinkPosesAreTakenAsTheyAre) {
  QueryMotion::Request request;
  request.links = {"rod"};
  request.poses.resize(2);
  for (int i = 0; i < 2; ++i) {
    request.poses[i].time_from_start = ros::Duration(i);
    request.poses[i].poses.resize(1);
    request.poses[i].poses[0].position.x = i;
    request.poses[i].poses[0].orientation.w = 2.0;
  }
  const CycleMotion result = motion(request);
  EXPECT_EQ(result.missing[0], "");
  EXPECT_EQ(result.X_WB[0][1].translation(), Vector3d(1.0, 0.0, 0.0));
  request.poses[1].poses[0].orientation.w = 0.0;
  EXPECT_EQ(refusal(request), "orientation is not a quaternion");
  request.links = {"tail"};
  EXPECT_EQ(refusal(request), "the robot has no link tail");
}

TEST_F(PlannedMotionTest, BadRequestsAreRefusedWithTheReason) {
  EXPECT_EQ(refusal(QueryMotion::Request()), "give either a trajectory or poses of links");
  EXPECT_EQ(refusal(swing({0.0})), "the trajectory has 1 points, two or more are needed");
  QueryMotion::Request request = swing({0.0, 1.0});
  request.trajectory.points[1].time_from_start = ros::Duration(0.5);
  EXPECT_EQ(refusal(request), "the trajectory: time_from_start of point 1 does not increase");
  request = swing({0.0, 1.0});
  request.trajectory.points[1].positions.clear();
  EXPECT_EQ(refusal(request), "point 1 of the trajectory has 0 positions for 1 joints");
  request = swing({0.0, 1.0});
  request.trajectory.joint_names = {"swong"};
  EXPECT_NE(refusal(request).find("swong"), std::string::npos);
}

}  // namespace
}  // namespace sdf_ccd
