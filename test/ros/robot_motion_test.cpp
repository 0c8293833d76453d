#include "ros/messages/robot_motion.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "motion/screw_motion.h"
#include "motion/motion_sampling.h"
#include "oracle/failure.h"
#include "robot/planned_motion.h"
#include "ros/messages/conversions.h"

namespace sdf_ccd::robot_motion_test {

const char* const kUrdf = R"(<robot name="pendulum">
  <link name="base"/>
  <link name="rod"/>
  <joint name="swing" type="revolute">
    <parent link="base"/><child link="rod"/><origin xyz="0 0 1"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/>
  </joint>
</robot>)";

class RobotMotionTest : public ::testing::Test {
 protected:
  RobotMotionTest() {
    Body rod, wall;
    rod.name = rod.frame = "rod";
    wall.name = "wall";
    wall.is_world = true;
    for (Body* body : {&rod, &wall}) body->X_frame_B.setIdentity();
    scene_.bodies = BodyList({rod, wall});
    now_.X_WR = Eigen::Translation3d(2.0, 0.0, 0.0);
    now_.known_by = "tf";
    now_.bodies.missing = {"no transform", ""};
    now_.bodies.bodies = {{1, Isometry3d::Identity(), {}}, {-1, Isometry3d(Eigen::Translation3d(0.0, 5.0, 0.0)), {}}};
  }

  static RobotMotion swing(std::vector<double> positions) {
    RobotMotion request;
    request.joint_trajectory.joint_names = {"swing"};
    for (std::size_t i = 0; i < positions.size(); ++i) {
      trajectory_msgs::JointTrajectoryPoint point;
      point.positions = {positions[i]};
      point.time_from_start = ros::Duration(1.0 + i);
      request.joint_trajectory.points.push_back(point);
    }
    return request;
  }

  CycleMotion motion(const RobotMotion& request) {
    planned_ = toPlannedMotion(request, {scene_, robot_, "virtual", now_, rules_, X_WM_, frame_missing_}, {});
    samples_ = planned_.samples;
    CycleMotion motion;
    planned_.piece(0, planned_.waypoints.size() - 1, motion);
    return motion;
  }

  std::string refusal(const RobotMotion& request) {
    return test::failureOf<std::invalid_argument>([&] { motion(request); });
  }

  RobotModel robot_{kUrdf};
  Scene scene_;
  PresentState now_;
  PlanRules rules_;
  Isometry3d X_WM_ = Isometry3d::Identity();
  std::string frame_missing_;
  PlannedMotion planned_;
  std::vector<double> samples_;
};

TEST_F(RobotMotionTest, TrajectoryMovesLinksWhereverTfHasThem) {
  const CycleMotion result = motion(swing({0.0, M_PI_2, 0.0}));
  EXPECT_EQ(samples_, (std::vector<double>{0.0, 1.0, 2.0}));
  const std::size_t middle = std::find(result.times.begin(), result.times.end(), 1.0) - result.times.begin();
  ASSERT_LT(middle, result.times.size());
  EXPECT_EQ(result.missing[0], "");
  EXPECT_LT((result.X_WB[0][middle] * Vector3d(0.0, 0.0, -1.0) - Vector3d(1.0, 0.0, 1.0)).norm(), 1e-12);
  EXPECT_EQ(result.X_WB[1][middle].translation(), Vector3d(0.0, 5.0, 0.0));
}

TEST_F(RobotMotionTest, WholeRevolutionsAreNotTakenForRest) {
  rules_.allow_beyond_limits = true;
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
  EXPECT_NE(refusal(swing({0.0, 1e9})).find("rotates links by 1e+09 rad up to point 1, and by 1e+09 rad before it"),
            std::string::npos);
  EXPECT_NE(refusal(swing({0.0, 1e300})).find("1e+300"), std::string::npos);
}

TEST_F(RobotMotionTest, TimesFartherApartThanADurationHoldsAreRefused) {
  RobotMotion request = swing({0.0, 0.1});
  request.joint_trajectory.points[0].time_from_start = ros::Duration(-2147483648.0);
  request.joint_trajectory.points[1].time_from_start = ros::Duration(2147483647.0);
  EXPECT_EQ(refusal(request),
            "the trajectory: time_from_start of point 1 is 4.29497e+09 s after the first point; a ros::Duration "
            "holds at most 2147483647 s");
}

TEST_F(RobotMotionTest, WhatIsToKnowOfPresentPosesIsNoted) {
  PlannedScene planned{scene_, robot_, "virtual", now_, {}};
  planned.note = "old";
  EXPECT_EQ(toPlannedMotion(swing({0.0, 1.0}), planned, {}).notes, std::vector<std::string>{"old"});
}

TEST_F(RobotMotionTest, UnknownRootMakesAllLinksMissing) {
  now_.root_missing = "no map";
  EXPECT_EQ(motion(swing({0.0, 1.0})).missing[0], "no map");
}

TEST_F(RobotMotionTest, LinkPosesAreTakenAsTheyAre) {
  RobotMotion request;
  request.link_trajectory.link_names = {"rod"};
  request.link_trajectory.points.resize(2);
  for (int i = 0; i < 2; ++i) {
    request.link_trajectory.points[i].time_from_start = ros::Duration(i);
    request.link_trajectory.points[i].poses.resize(1);
    request.link_trajectory.points[i].poses[0].position.x = i;
    request.link_trajectory.points[i].poses[0].orientation.w = 1.004;
  }
  const CycleMotion result = motion(request);
  EXPECT_EQ(result.missing[0], "");
  EXPECT_EQ(result.X_WB[0][1].translation(), Vector3d(1.0, 0.0, 0.0));
  for (const double w : {0.9, 2.0}) {
    request.link_trajectory.points[1].poses[0].orientation.w = w;
    EXPECT_EQ(refusal(request), "orientation is not a unit quaternion");
  }
  request.link_trajectory.points[1].poses[0].orientation.w = 0.0;
  EXPECT_EQ(refusal(request), "orientation is a quaternion of zeros: write orientation.w: 1");
  request.link_trajectory.points[1].poses[0].orientation.w = 1.0;
  request.link_trajectory.link_names = {"tail"};
  EXPECT_EQ(refusal(request), "the robot has no link tail");
}

/// Frames of tf are known up to different times: what is not named moves as one.
TEST_F(RobotMotionTest, OtherLinksAreWhereTheirJointsAre) {
  RobotMotion request;
  request.link_trajectory.link_names = {"base"};
  request.link_trajectory.points.resize(2);
  request.link_trajectory.points[1].time_from_start = ros::Duration(1.0);
  for (LinkTrajectoryPoint& point : request.link_trajectory.points)
    point.poses.push_back(toPose(Isometry3d::Identity()));
  EXPECT_NE(motion(request).missing[0], "");
  const Isometry3d X_PL = Eigen::Translation3d(0.0, 0.0, 1.0) * Eigen::AngleAxisd(0.3, Vector3d::UnitY());
  now_.joints.X_PL["swing"] = X_PL;
  const CycleMotion result = motion(request);
  EXPECT_EQ(result.missing[0], "");
  EXPECT_TRUE(result.X_WB[0][1].isApprox(now_.X_WR * X_PL, 1e-12));
  now_.root_missing = "no map";
  EXPECT_EQ(motion(request).missing[0], "no map");
}

/// Two links that rotate by +2 and −2 rad about one axis rotate by 4 rad relative to each other: each takes its own
/// shorter rotation.
TEST_F(RobotMotionTest, EachLinkFollowsItsOwnShortestWay) {
  RobotMotion request;
  request.link_trajectory.link_names = {"rod", "base"};
  request.link_trajectory.points.resize(2);
  for (int i = 0; i < 2; ++i) {
    request.link_trajectory.points[i].time_from_start = ros::Duration(i);
    for (const double angle : {2.0, -2.0}) {
      request.link_trajectory.points[i].poses.push_back(
          toPose(Isometry3d(Eigen::AngleAxisd(i * angle, Vector3d::UnitZ()))));
    }
  }
  Body base = scene_.bodies[0];
  base.name = base.frame = "base";
  scene_.bodies.push_back(base);
  now_.bodies.missing.push_back("");
  now_.bodies.bodies.push_back({0, Isometry3d::Identity(), {}});
  const CycleMotion result = motion(request);
  EXPECT_NEAR(ScrewMotion(result.X_WB[0][0], result.X_WB[0][1]).angularVelocity().z(), 2.0, 1e-12);
  EXPECT_NEAR(ScrewMotion(result.X_WB[2][0], result.X_WB[2][1]).angularVelocity().z(), -2.0, 1e-12);
  for (const double angle : {M_PI, M_PI - 5e-7, -M_PI}) {
    request.link_trajectory.points[1].poses[0] = toPose(Isometry3d(Eigen::AngleAxisd(angle, Vector3d::UnitZ())));
    EXPECT_EQ(refusal(request),
              "link rod rotates by half a revolution between poses 0 and 1, so the direction is ambiguous; add a pose "
              "in between");
  }
  request.link_trajectory.points[1].poses[0] = toPose(Isometry3d(Eigen::AngleAxisd(M_PI - 1e-5, Vector3d::UnitZ())));
  EXPECT_EQ(refusal(request), "");
}

TEST_F(RobotMotionTest, JointsThatAreNotNamedAreWhereTfHasThem) {
  RobotMotion request = swing({0.0, 1.0});
  request.joint_trajectory.joint_names.clear();
  for (auto& point : request.joint_trajectory.points) point.positions.clear();
  Isometry3d X_PL(Eigen::Translation3d(0.0, 0.0, 1.0) * Eigen::AngleAxisd(M_PI_2, Vector3d::UnitY()));
  now_.joints.X_PL["swing"] = X_PL;
  const CycleMotion result = motion(request);
  EXPECT_TRUE(result.X_WB[0][1].isApprox(now_.X_WR * X_PL, 1e-12));
  ASSERT_EQ(planned_.assumed.size(), 1u);
  EXPECT_EQ(planned_.assumed[0].name, "swing");
  EXPECT_NEAR(planned_.assumed[0].position, M_PI_2, 1e-12);
  EXPECT_EQ(planned_.notes,
            std::vector<std::string>{"not named, hence assumed to stay where tf has them: 1 joint, swing"});
  now_.joints.X_PL.clear();
  now_.joints.missing["swing"] = "no transform";
  EXPECT_EQ(motion(request).missing[0],
            "joint swing is not in the plan, and its current position is unknown: no transform");
}

TEST_F(RobotMotionTest, ObjectsInALinksFrameMoveWithIt) {
  now_.bodies.bodies[1] = {1, Isometry3d(Eigen::Translation3d(0.0, 0.0, -1.0)), {}};
  EXPECT_LT((motion(swing({0.0, M_PI_2})).X_WB[1].back().translation() - Vector3d(1.0, 0.0, 1.0)).norm(), 1e-12);
}

TEST_F(RobotMotionTest, TheRootMovesByAMultiDofTrajectory) {
  for (const std::string name : {"virtual", "base"}) {
    RobotMotion request = swing({0.0, 1.0, 2.0});
    request.multi_dof_joint_trajectory.joint_names = {name};
    request.multi_dof_joint_trajectory.points.resize(2);
    for (int i = 0; i < 2; ++i) {
      auto& point = request.multi_dof_joint_trajectory.points[i];
      point.time_from_start = ros::Duration(1.0 + 2.0 * i);
      point.transforms.resize(1);
      point.transforms[0].translation.x = 4.0 * i;
      point.transforms[0].rotation.w = 1.0;
    }
    X_WM_ = Eigen::Translation3d(0.0, 7.0, 0.0);
    now_.root_missing = "not known, and not needed";
    const CycleMotion result = motion(request);
    EXPECT_EQ(samples_, (std::vector<double>{0.0, 1.0, 2.0}));
    EXPECT_EQ(result.missing[0], "");
    const auto middle = std::find(result.times.begin(), result.times.end(), 1.0) - result.times.begin();
    EXPECT_LT((result.X_WB[0][middle].translation() - Vector3d(2.0, 7.0, 1.0)).norm(), 1e-12);
    frame_missing_ = "no map";
    EXPECT_EQ(motion(request).missing[0], "no map");
    frame_missing_ = "";
    request.multi_dof_joint_trajectory.points[1].time_from_start = ros::Duration(4.0);
    EXPECT_EQ(refusal(request), "two trajectories do not begin and end at the same times");
    request.multi_dof_joint_trajectory.points[1].transforms[0].rotation.w = 0.0;
    EXPECT_EQ(refusal(request), "rotation is a quaternion of zeros: write rotation.w: 1");
  }
}

/// An object that moves with the base cannot be used to check the base's motion.
TEST_F(RobotMotionTest, ObjectsThatMoveWithTheBaseAreSaid) {
  const auto base = [] {
    RobotMotion request;
    request.multi_dof_joint_trajectory.joint_names = {"virtual"};
    request.multi_dof_joint_trajectory.points.resize(2);
    for (int i = 0; i < 2; ++i) {
      auto& point = request.multi_dof_joint_trajectory.points[i];
      point.time_from_start = ros::Duration(i);
      point.transforms.resize(1);
      point.transforms[0].translation.x = i;
      point.transforms[0].rotation.w = 1.0;
    }
    return request;
  }();
  const auto carried = [&] {
    return std::count_if(planned_.notes.begin(), planned_.notes.end(), [](const std::string& note) {
      return note.find("these objects move with the robot's base") == 0 && note.find("wall") != std::string::npos;
    });
  };
  motion(base);
  EXPECT_EQ(carried(), 0) << "it rests";
  now_.bodies.bodies[1] = {0, Isometry3d::Identity(), {}};
  motion(base);
  EXPECT_EQ(carried(), 1);
  motion(swing({0.0, 0.1}));
  EXPECT_EQ(carried(), 0) << "the base rests";
}

TEST_F(RobotMotionTest, BadRequestsAreRefusedWithTheReason) {
  EXPECT_EQ(refusal(RobotMotion()), "give either trajectories of joints or of links, and not both");
  EXPECT_EQ(refusal(swing({0.0})), "the trajectory has 1 points; two or more are needed");
  RobotMotion request = swing({0.0, 1.0});
  request.joint_trajectory.points[1].time_from_start = ros::Duration(0.5);
  EXPECT_EQ(refusal(request),
            "the trajectory: time_from_start of point 1 is not greater than that of the point before");
  request = swing({0.0, 1.0});
  request.joint_trajectory.points[1].positions.clear();
  EXPECT_EQ(refusal(request), "point 1 of the trajectory has 0 positions for 1 joints");
  request = swing({0.0, 1.0});
  request.other_joints.name = {"swing"};
  request.other_joints.position = {0.0};
  EXPECT_EQ(refusal(request), "joint swing is named twice");
  EXPECT_EQ(refusal(swing({0.0, 3.5})), "joint swing: position 3.5 is beyond its limits [-3, 3] (waypoint 1)");
  request = swing({0.0, 3.5});
  rules_.allow_beyond_limits = true;
  EXPECT_EQ(refusal(request), "");
  request = swing({0.0, 1.0});
  request.joint_trajectory.joint_names = {"swong"};
  EXPECT_NE(refusal(request).find("swong"), std::string::npos);
}

}  // namespace sdf_ccd::robot_motion_test
