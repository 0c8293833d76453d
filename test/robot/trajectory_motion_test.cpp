#include "robot/trajectory_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "motion/chain_derivatives.h"
#include "motion/motion_sampling.h"
#include "oracle/exact_motion.h"
#include "oracle/failure.h"
#include "robot/planned_motion.h"
#include "robot/random_robot.h"

namespace sdf_ccd::trajectory_motion_test {

using test::Random;

constexpr double kPi = 3.14159265358979323846;
const BoundingBall kUnitBall = {Vector3d::Zero(), 1.0};

struct Case {
  RobotTrajectory trajectory;
  CarriedBody body;
  MotionSampling sampling;
  double size = 0.0;  ///< of robot and slides [m]: rounding errors are some 1e-16 of it
};

struct Errors {
  double bound = 0.0;  ///< reported bound [m]
  double worst = 0.0;  ///< largest error found [m]
};

CycleMotion sampled(const RobotModel& robot, const Case& a_case) {
  TrajectoryMotion motion(robot, a_case.trajectory, {a_case.body});
  CycleMotion result;
  sampleMotion(motion.waypoints(), motion.source(), {a_case.body.ball_B}, a_case.sampling, result);
  return result;
}

Errors errorsOf(const RobotModel& robot, const Case& a_case) {
  const CycleMotion motion = sampled(robot, a_case);
  return {motion.motion_error[0],
          test::worstError(robot, a_case.trajectory, a_case.body, motion.times, motion.X_WB[0])};
}

Case randomCase(Random& random, const RobotModel& robot, double scale) {
  Case a_case;
  const double turn = std::pow(10.0, test::uniform(random, -3, 1));
  a_case.trajectory = test::randomTrajectory(random, robot, 2 + random() % 2, turn, scale);
  a_case.body.link = static_cast<int>(robot.links().size()) - 1;
  a_case.body.X_LB = test::pose(random, 3, 0.3 * scale);
  a_case.body.ball_B = {test::uniform(random, 0, 0.5) * scale * test::direction(random),
                        test::uniform(random, 0, 0.5) * scale};
  a_case.sampling.tolerance = scale * std::pow(10.0, test::uniform(random, -5, -1));
  a_case.sampling.max_halvings = static_cast<int>(random() % 4);
  a_case.size = 10.0 * scale;
  return a_case;
}

/// Tolerance for the rounding of poses and of the deviations measured halfway.
double rounding(const Case& a_case) {
  return 1e-13 * a_case.size;
}

TEST(TrajectoryMotion, NoChainOfJointsMovesFartherFromItsSamplesThanIsReported) {
  Random random(11);
  std::vector<double> looseness;
  for (int i = 0; i < 400; ++i) {
    const double scale = std::pow(10.0, test::uniform(random, -3, 3));
    const RobotModel robot(test::randomChain(random, 1 + i % 7, scale));
    const Case a_case = randomCase(random, robot, scale);
    const Errors errors = errorsOf(robot, a_case);
    ASSERT_LE(errors.worst, errors.bound + rounding(a_case)) << i;
    if (errors.worst > 1e-9 * scale) looseness.push_back(errors.bound / errors.worst);
  }
  ASSERT_GT(looseness.size(), 200u);
  std::nth_element(looseness.begin(), looseness.begin() + looseness.size() / 2, looseness.end());
  RecordProperty("median_bound_over_error", std::to_string(looseness[looseness.size() / 2]));
  EXPECT_LT(looseness[looseness.size() / 2], 5.0);
}

/// Climbs over the joints' displacements for the largest share of the reported bound.
TEST(TrajectoryMotion, NoChoiceOfRatesGetsBeyondTheBound) {
  Random random(12);
  double most = 0.0;
  for (int start = 0; start < 20; ++start) {
    const double scale = std::pow(10.0, test::uniform(random, -3, 3));
    const RobotModel robot(test::randomChain(random, 2 + start % 4, scale));
    Case best = randomCase(random, robot, scale);
    best.sampling = {1e-9 * scale, 0};
    double share = 0.0;
    for (int step = 0; step < 40; ++step) {
      Case next = best;
      for (auto& [joint, position] : next.trajectory.states[1].positions) {
        position += std::pow(10.0, test::uniform(random, -3, 0)) * test::uniform(random, -1, 1);
      }
      next.body.ball_B.center += 0.1 * scale * test::uniform(random, 0, 1) * test::direction(random);
      const Errors errors = errorsOf(robot, next);
      ASSERT_LE(errors.worst, errors.bound + rounding(next));
      if (errors.bound > 1e-9 * scale && errors.worst / errors.bound > share) {
        share = errors.worst / errors.bound;
        best = next;
      }
    }
    most = std::max(most, share);
  }
  EXPECT_GT(most, 0.4);  // climbing does approach the bound
}

/// The elbow folds while shoulder and hand joint keep the hand's orientation: the hand moves along a line, slower at
/// both ends than halfway, where it is exactly on time.
TEST(TrajectoryMotion, SumOfEvenTurnsMayBeSShaped) {
  const RobotModel robot(R"(<robot name='r'><link name='a'/><link name='b'/><link name='c'/><link name='d'/>
    <joint name='i' type='continuous'><parent link='a'/><child link='b'/><axis xyz='0 0 1'/></joint>
    <joint name='j' type='continuous'><parent link='b'/><child link='c'/><origin xyz='1 0 0'/><axis xyz='0 0 1'/></joint>
    <joint name='k' type='continuous'><parent link='c'/><child link='d'/><origin xyz='1 0 0'/><axis xyz='0 0 1'/></joint>
    </robot>)");
  const auto folded = [](double a) {
    RobotState state;
    state.positions = {{"i", a}, {"j", kPi - 2.0 * a}, {"k", a}};
    return state;
  };
  Case a_case;
  a_case.trajectory = {{0.0, 1.0}, {folded(-0.12), folded(0.12)}};
  a_case.body.link = 3;
  a_case.body.ball_B.radius = 1e-3;  // so that the links alone determine the bound
  a_case.sampling = {1e-4, 0};
  const CycleMotion motion = sampled(robot, a_case);
  ASSERT_EQ(motion.times.size(), 2u);
  const RobotState &start = a_case.trajectory.states[0], &end = a_case.trajectory.states[1];
  const test::Pose middle = test::screwBetween(test::exact(motion.X_WB[0][0]), test::exact(motion.X_WB[0][1]), 0.5L);
  const test::Pose true_middle = test::linkBetween(robot, start, end, 3, 0.5L);
  EXPECT_LT(test::farthestApart(true_middle, middle, a_case.body.ball_B), 1e-15);
  const Errors errors = errorsOf(robot, a_case);
  EXPECT_NEAR(errors.worst, 2.2e-4, 1e-5);
  EXPECT_GE(errors.bound, errors.worst);
  a_case.sampling.max_halvings = 5;
  EXPECT_LE(errorsOf(robot, a_case).bound, 1e-4);
}

/// One joint from rest to rest along a polynomial of degree five: halfway it is exactly where a uniform rotation is.
TEST(TrajectoryMotion, QuinticTimingIsBoundedByItsDerivatives) {
  const double angle = 1.0, radius = 0.9;
  const BoundingBall ball = {Vector3d(radius, 0, 0), 0.0};
  const auto poseAt = [&](double s) {
    const double share = s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
    return Isometry3d(Eigen::AngleAxisd(share * angle, Vector3d::UnitZ()));
  };
  MotionSource source;
  source.poses_at = [&](double time, std::vector<Isometry3d>& X_WB) { X_WB = {poseAt(time)}; };
  source.jerk_bounds = [&](double start, double end, std::vector<double>& jerk) {
    const double h = end - start;  // the largest derivatives over the whole motion
    ChainDerivatives chain(ball);
    chain.addFrame(0.0, {1.875 * angle * h, 10.0 / std::sqrt(3.0) * angle * h * h, 60.0 * angle * h * h * h}, {});
    jerk = {chain.jerk()};
  };
  const ScrewMotion screw(poseAt(0.0), poseAt(1.0));
  const auto errorAt = [&](double s) { return (screw.pose(s) * ball.center - poseAt(s) * ball.center).norm(); };
  EXPECT_LT(errorAt(0.5), 1e-15);
  EXPECT_NEAR(errorAt(0.24), 0.132, 1e-3);

  CycleMotion motion;
  sampleMotion({0.0, 1.0}, source, {ball}, {1e-4, 0}, motion);
  EXPECT_GE(motion.motion_error[0], errorAt(0.24));
  sampleMotion({0.0, 1.0}, source, {ball}, {1e-4, 8}, motion);
  EXPECT_LE(motion.motion_error[0], 1e-4);
  double worst = 0.0;
  for (std::size_t i = 1; i < motion.times.size(); ++i) {
    const ScrewMotion piece(motion.X_WB[0][i - 1], motion.X_WB[0][i]);
    for (double s = 0.05; s < 1.0; s += 0.05) {
      const double time = (1.0 - s) * motion.times[i - 1] + s * motion.times[i];
      worst = std::max(worst, (piece.pose(s) * ball.center - poseAt(time) * ball.center).norm());
    }
  }
  EXPECT_LE(worst, motion.motion_error[0]);
  EXPECT_GT(worst, 0.1 * motion.motion_error[0]);
}

const char* const kTwoArms = R"(<robot name='r'><link name='base'/><link name='left'/><link name='right'/>
  <link name='tool'/>
  <joint name='l' type='revolute'><parent link='base'/><child link='left'/><axis xyz='0 0 1'/>
    <limit lower='-3' upper='3' effort='1' velocity='1'/></joint>
  <joint name='r' type='continuous'><parent link='base'/><child link='right'/><origin xyz='1 0 0'/><axis xyz='0 0 2'/>
  </joint>
  <joint name='t' type='prismatic'><parent link='left'/><child link='tool'/><axis xyz='1 0 0'/>
    <limit lower='0' upper='1' effort='1' velocity='1'/></joint></robot>)";

RobotTrajectory twoArms(const JointPositions& from, const JointPositions& to) {
  return {{0.0, 1.0}, {RobotState{Isometry3d::Identity(), from, {}}, RobotState{Isometry3d::Identity(), to, {}}}};
}

TEST(TrajectoryMotion, TurnsAddUpAlongAChainAndCountWholeRevolutions) {
  const RobotModel robot(kTwoArms);
  const auto pieces = [&](const JointPositions& from, const JointPositions& to) {
    return TrajectoryMotion(robot, twoArms(from, to), {}).waypoints().size() - 1;
  };
  EXPECT_EQ(pieces({{"l", 0.0}, {"t", 0.0}}, {{"l", 1.0}, {"t", 9.0}}), 1u);
  EXPECT_EQ(pieces({{"l", 0.0}, {"r", 0.0}}, {{"l", 0.9}, {"r", -0.9}}), 1u);  // on two branches
  EXPECT_EQ(pieces({{"r", 0.0}}, {{"r", 8.0 * kPi}}), 26u);
  RobotTrajectory trajectory = twoArms({{"l", 0.0}}, {{"l", 0.9}});
  trajectory.states[1].X_WR = Isometry3d(Eigen::AngleAxisd(0.9, Vector3d::UnitX()));
  EXPECT_EQ(TrajectoryMotion(robot, trajectory, {}).waypoints().size(), 3u);
  EXPECT_THROW(pieces({{"r", 0.0}}, {{"r", 1e9}}), std::invalid_argument);
}

TEST(TrajectoryMotion, WhatRestsOrSlidesHasNoError) {
  const RobotModel robot(kTwoArms);
  Random random(3);
  const std::vector<CarriedBody> bodies = {{-1, test::pose(random, 3.0, 1.0), kUnitBall},
                                           {0, Isometry3d::Identity(), kUnitBall},
                                           {1, Isometry3d::Identity(), kUnitBall},
                                           {3, Isometry3d::Identity(), kUnitBall}};
  TrajectoryMotion motion(robot, twoArms({{"l", 0.5}, {"t", 0.0}}, {{"l", 0.5}, {"t", 0.3}}), bodies);
  CycleMotion result;
  sampleMotion(motion.waypoints(), motion.source(), {kUnitBall, kUnitBall, kUnitBall, kUnitBall}, {}, result);
  EXPECT_EQ(result.times.size(), 2u);
  EXPECT_EQ(result.motion_error[0], 0.0);
  EXPECT_EQ(result.motion_error[1], 0.0);
  EXPECT_EQ(result.motion_error[2], 0.0);
  EXPECT_LT(result.motion_error[3], 1e-15);
  EXPECT_EQ(result.X_WB[0][1].matrix(), bodies[0].X_LB.matrix());
}

TEST(TrajectoryMotion, BetweenTimesOnBothSidesOfAWaypointNothingIsBounded) {
  const RobotModel robot(kTwoArms);
  RobotTrajectory trajectory = twoArms({{"l", 0.0}}, {{"l", 0.1}});
  trajectory.times.push_back(2.0);
  trajectory.states.push_back(trajectory.states[0]);
  TrajectoryMotion motion(robot, trajectory, {{1, Isometry3d::Identity(), kUnitBall}});
  std::vector<double> jerk;
  motion.source().jerk_bounds(0.5, 1.5, jerk);
  EXPECT_TRUE(std::isinf(jerk[0]));
  motion.source().jerk_bounds(1.0, 2.0, jerk);
  EXPECT_NEAR(jerk[0], 1e-3, 1e-12);
}

TEST(TrajectoryMotion, RefusesWhatIsNoTrajectory) {
  const RobotModel robot(kTwoArms);
  const auto refusal = [&](const RobotTrajectory& trajectory) {
    return test::failureOf<std::invalid_argument>([&] { TrajectoryMotion(robot, trajectory, {}); });
  };
  RobotTrajectory trajectory = twoArms({{"l", 0.0}}, {{"l", 1.0}});
  trajectory.times[1] = 0.0;
  EXPECT_EQ(refusal(trajectory), "the time of waypoint 1 does not increase");
  EXPECT_EQ(refusal({{0.0}, {RobotState()}}), "a trajectory needs two waypoints or more");
  EXPECT_EQ(refusal(twoArms({{"l", 0.0}}, {{"r", 0.0}})), "waypoint 1 does not name the joints of the first one");
  EXPECT_NE(refusal(twoArms({{"x", 0.0}}, {{"x", 0.0}})).find("has no joint x"), std::string::npos);
  trajectory = twoArms({}, {});
  trajectory.states[1].X_WR = Isometry3d(Eigen::AngleAxisd(kPi - 1e-7, Vector3d::UnitX()));
  EXPECT_EQ(refusal(trajectory),
            "the robot's root rotates by half a revolution between poses 0 and 1, so the direction is ambiguous; add a "
            "pose in between");
  trajectory.states[1].X_WR = Isometry3d(Eigen::AngleAxisd(kPi - 1e-5, Vector3d::UnitX()));
  EXPECT_EQ(refusal(trajectory), "");
  trajectory.states[1].X_WR = Isometry3d(Eigen::Translation3d(0.0, 1.1e8, 0.0));
  EXPECT_EQ(refusal(trajectory), "the robot's root: a pose is more than 1e+08 m from the origin");
}

TEST(TrajectoryMotion, TwoTrajectoriesMergeAtTheTimesOfBoth) {
  RobotTrajectory joints = {{0.0, 1.0, 3.0}, std::vector<RobotState>(3)};
  for (const int i : {0, 1, 2}) joints.states[i].positions["l"] = i == 1 ? 2.0 : 0.0;
  RobotTrajectory base = {{0.0, 2.0, 3.0}, std::vector<RobotState>(3)};
  base.states[1].X_WR = Isometry3d(Eigen::Translation3d(4.0, 0.0, 0.0));
  const RobotTrajectory both = merged(joints, base);
  EXPECT_EQ(both.times, (std::vector<double>{0.0, 1.0, 2.0, 3.0}));
  EXPECT_EQ(both.states[2].positions.at("l"), 1.0);
  EXPECT_EQ(both.states[1].X_WR.translation().x(), 2.0);
  EXPECT_EQ(both.states[2].X_WR.translation().x(), 4.0);
  base.times = {0.0, 2.0, 3.5};
  EXPECT_THROW(merged(joints, base), std::invalid_argument);
}

}  // namespace sdf_ccd::trajectory_motion_test
