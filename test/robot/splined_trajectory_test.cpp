#include <gtest/gtest.h>

#include <stdexcept>

#include "oracle/random.h"
#include "robot/joint_spline.h"
#include "robot/planned_motion.h"
#include "robot/trajectory_motion.h"

namespace sdf_ccd::splined_trajectory_test {

using test::Random;
using test::uniform;

const char* const kRobot = R"(
<robot name='r'><link name='base'/><link name='a'/><link name='b'/><link name='c'/><link name='d'/>
  <joint name='turn' type='continuous'><parent link='base'/><child link='a'/><origin xyz='0.1 0 0.3' rpy='0.2 0.1 0'/>
    <axis xyz='0 1 0'/></joint>
  <joint name='slide' type='prismatic'><parent link='a'/><child link='b'/><origin xyz='0.4 0.1 0' rpy='0 0.4 0'/>
    <axis xyz='1 0 0'/><limit lower='-9' upper='9' effort='1' velocity='1'/></joint>
  <joint name='spin' type='continuous'><parent link='b'/><child link='c'/><origin xyz='0.5 0 0'/><axis xyz='0 0 1'/></joint>
  <joint name='mimic' type='continuous'><parent link='c'/><child link='d'/><origin xyz='0.3 0 0'/><axis xyz='0 0 1'/>
    <mimic joint='spin' multiplier='-2'/></joint>
</robot>)";

JointWaypoint anyPoint(Random& random, double time, int kind) {
  JointWaypoint point;
  point.time = time;
  for (int k = 0; k < 3; ++k) {
    point.positions.push_back(uniform(random, -1, 1));
    if (kind > 0) point.velocities.push_back(uniform(random, -2, 2));
    if (kind > 1) point.accelerations.push_back(uniform(random, -4, 4));
  }
  return point;
}

TEST(SplinedTrajectory, NoPointOfABodyStraysFartherFromTheSplineThanItSays) {
  Random random(6);
  const RobotModel robot(kRobot);
  const std::vector<std::string> joints = {"turn", "slide", "spin"};
  const CarriedBody body{4, test::pose(random, 1.0, 0.2), {Vector3d(0.1, 0, 0), 0.1}};
  double largest = 0.0;
  for (int run = 0; run < 20; ++run) {
    const int kind = run % 3;
    std::vector<JointWaypoint> points;
    for (int i = 0; i < 3; ++i) points.push_back(anyPoint(random, 0.7 * i, kind));
    const double tolerance = 1e-3;
    const RobotTrajectory trajectory = splined(joints, points, tolerance);
    EXPECT_EQ(trajectory.joint_error, kind == 0 ? 0.0 : tolerance);
    if (kind == 0) {
      EXPECT_EQ(trajectory.times.size(), 3u);
    }
    const TrajectoryMotion motion(robot, trajectory, {body});
    const double error = motion.jointErrors().at(0);
    const JointSplineOrder order = kind == 0   ? JointSplineOrder::kLinear
                                   : kind == 1 ? JointSplineOrder::kCubic
                                               : JointSplineOrder::kQuintic;
    for (int i = 0; i < 400; ++i) {
      const double time = 1.4 * i / 400.0;
      const std::size_t from = time < 0.7 ? 0 : 1;
      JointPositions truth;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto knot = [&](const JointWaypoint& p) {
          return JointSplinePoint{p.positions[k], kind > 0 ? p.velocities[k] : 0.0,
                                  kind > 1 ? p.accelerations[k] : 0.0};
        };
        truth[joints[k]] =
            JointSpline(order, knot(points[from]), knot(points[from + 1]), 0.7).position(time - points[from].time);
      }
      const Isometry3d X_true = robot.forwardKinematics(truth)[4] * body.X_LB;
      const Isometry3d X_said = robot.forwardKinematics(stateAt(trajectory, time).positions)[4] * body.X_LB;
      for (int k = 0; k < 4; ++k) {
        const Vector3d p = body.ball_B.center + body.ball_B.radius * test::direction(random);
        const double off = (X_true * p - X_said * p).norm();
        EXPECT_LE(off, error + 1e-12);
        if (kind > 0) largest = std::max(largest, off / error);
      }
    }
  }
  EXPECT_GT(largest, 0.3);
}

TEST(SplinedTrajectory, WhatDoesNotFitIsRefused) {
  const std::vector<JointWaypoint> good = {{0.0, {0.0}, {1.0}, {}}, {1.0, {0.0}, {1.0}, {}}};
  EXPECT_GT(splined({"j"}, good, 1e-3).times.size(), 10u);
  std::vector<JointWaypoint> bad = good;
  bad[1].velocities = {1.0, 2.0};
  EXPECT_THROW(splined({"j"}, bad, 1e-3), std::invalid_argument);
  bad = good;
  bad[0].velocities = {1e12};
  EXPECT_THROW(splined({"j"}, bad, 1e-3), std::invalid_argument);
}

}  // namespace sdf_ccd::splined_trajectory_test
