#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "oracle/random.h"
#include "robot/planned_motion.h"
#include "robot/trajectory_motion.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::two_arms_test {

constexpr double kBall = 0.05, kArm = 0.8;  // [m]
const Vector3d kRod(0.4, 0.02, 0.02);       // half size [m]

/// A ball at the end of one arm, a rod as the other one; each test places both arms.
const char* const kTwoArms = R"(<robot name='r'>
  <link name='world'/><link name='left_base'/><link name='right_base'/><link name='upper'/>
  <link name='ball'><collision><origin xyz='0.8 0 0'/><geometry><sphere radius='0.05'/></geometry></collision></link>
  <link name='rod'><collision><origin xyz='0.4 0 0'/><geometry><box size='0.8 0.04 0.04'/></geometry></collision></link>
  <joint name='left_stand' type='floating'><parent link='world'/><child link='left_base'/></joint>
  <joint name='right_stand' type='floating'><parent link='world'/><child link='right_base'/></joint>
  <joint name='left' type='continuous'><parent link='left_base'/><child link='upper'/><axis xyz='0 0 1'/></joint>
  <joint name='wrist' type='continuous'><parent link='upper'/><child link='ball'/><axis xyz='0 1 0'/></joint>
  <joint name='right' type='continuous'><parent link='right_base'/><child link='rod'/><axis xyz='0 0 1'/></joint>
</robot>)";

class TwoArmsTest : public ::testing::Test {
 protected:
  TwoArmsTest() : robot_(kTwoArms) {
    std::vector<std::string> warnings;
    const SceneDescription description = describeRobot(robot_, {}, {}, {}, warnings);
    BodyOptions options;
    options.shell.spacing = 0.01;
    scene_ =
        std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(options)), options));
    monitor_ = std::make_unique<Monitor>(scene_, MonitorOptions());
    for (const Body& body : scene_->bodies) {
      const auto link = std::find(robot_.links().begin(), robot_.links().end(), body.name) - robot_.links().begin();
      bodies_.push_back({static_cast<int>(link), Isometry3d::Identity(), body.ball});
      balls_.push_back(bodies_.back().ball_B);
    }
  }

  Verdict verdict(const RobotTrajectory& trajectory) {
    TrajectoryMotion motion(robot_, trajectory, bodies_);
    CycleMotion cycle;
    sampleMotion(motion.waypoints(), motion.source(), balls_, {}, cycle);
    monitor_->reset();
    return monitor_->run(cycle, {}).verdict;
  }

  /// Centre of the ball in the frame of the left arm's stand.
  static Vector3d ballCenter(double yaw, double pitch) {
    return {kArm * std::cos(yaw) * std::cos(pitch), kArm * std::sin(yaw) * std::cos(pitch), -kArm * std::sin(pitch)};
  }

  /// A pose of the right arm's stand with which the ball grazes the rod's end, or nearly does, at some time.
  static Isometry3d standFor(test::Random& random, const JointPositions& from, const JointPositions& to,
                             const Isometry3d& X_left) {
    const double s = test::uniform(random, 0.1, 0.9), gap = test::uniform(random, -0.05, 0.1);
    const auto at = [&](const char* joint) { return (1.0 - s) * from.at(joint) + s * to.at(joint); };
    const Vector3d in_rod(2.0 * kRod.x() + kBall + gap, 0.0, 0.0);
    Isometry3d X_right = test::pose(random, 0.3, 0.0);
    const Vector3d in_stand = Eigen::AngleAxisd(at("right"), Vector3d::UnitZ()) * in_rod;
    X_right.translation() = X_left * ballCenter(at("left"), at("wrist")) - X_right.linear() * in_stand;
    return X_right;
  }

  /// Distance of ball and rod at s, from the joint angles alone [m].
  static double distance(const JointPositions& from, const JointPositions& to, const Isometry3d& X_left,
                         const Isometry3d& X_right, double s) {
    const auto at = [&](const char* joint) { return (1.0 - s) * from.at(joint) + s * to.at(joint); };
    const double yaw = at("left"), pitch = at("wrist"), turn = at("right");
    const Vector3d p = ballCenter(yaw, pitch);
    const Vector3d q = X_right.inverse() * (X_left * p);
    const Vector3d in_rod(std::cos(turn) * q.x() + std::sin(turn) * q.y() - kRod.x(),
                          std::cos(turn) * q.y() - std::sin(turn) * q.x(), q.z());
    const Vector3d out = in_rod.cwiseAbs() - kRod;
    return out.cwiseMax(0.0).norm() + std::min(0.0, out.maxCoeff()) - kBall;
  }

  RobotModel robot_;
  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<Monitor> monitor_;
  std::vector<CarriedBody> bodies_;
  std::vector<BoundingBall> balls_;
};

/// Both arms rotate between two waypoints: no verdict contradicts the joint angles.
TEST_F(TwoArmsTest, NoVerdictContradictsTheJointsAngles) {
  test::Random random(21);
  int counts[4] = {}, meetings = 0;
  for (int i = 0; i < 1500; ++i) {
    const double turn = std::pow(10.0, test::uniform(random, -1, 0.7));
    const auto angles = [&](const JointPositions& around) {
      JointPositions positions;
      for (const auto& [joint, position] : around) positions[joint] = position + test::uniform(random, -turn, turn);
      return positions;
    };
    const JointPositions from = angles({{"left", 0.0}, {"wrist", 0.0}, {"right", 3.0}});
    JointPositions to = angles(from);
    if (i % 3) to["wrist"] = from.at("wrist");  // each arm is then exactly a screw, but not relative to the other
    const Isometry3d X_left = test::pose(random, 0.3, 0.1);
    const Isometry3d X_right = standFor(random, from, to, X_left);
    RobotTrajectory trajectory = {{0.0, 1.0}, std::vector<RobotState>(2)};
    for (RobotState& state : trajectory.states) {
      state.positions = &state == &trajectory.states[0] ? from : to;
      state.poses = {{"left_stand", X_left}, {"right_stand", X_right}};
    }
    const Verdict result = verdict(trajectory);
    double least = 1.0;
    for (int k = 0; k <= 4000; ++k) least = std::min(least, distance(from, to, X_left, X_right, k / 4000.0));
    ++counts[static_cast<int>(result)];
    meetings += least < 0.0;
    ASSERT_FALSE(result == Verdict::kClear && least < 0.0) << i << ": they meet by " << -least;
    // Between two samples the distance changes by less than this.
    const double step = 2.0 * kArm * 3.0 * turn / 4000.0;
    ASSERT_FALSE(result == Verdict::kContact && least > step) << i << ": they are apart by " << least;
  }
  EXPECT_GT(meetings, 500);
  EXPECT_GT(counts[static_cast<int>(Verdict::kClear)], 500);
  EXPECT_GT(counts[static_cast<int>(Verdict::kContact)], 500);
  EXPECT_LT(counts[static_cast<int>(Verdict::kUncertain)], 300);
  EXPECT_EQ(counts[static_cast<int>(Verdict::kNotChecked)], 0);
}

}  // namespace sdf_ccd::two_arms_test
