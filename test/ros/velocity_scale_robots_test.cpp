// Stock robots move at full scale in an empty world, with the defaults.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include "oracle/files.h"
#include "oracle/test_data.h"
#include "ros/monitor/proximity_measure.h"
#include "ros/tf_messages.h"
#include "ros/world/describe_scene.h"
#include "scene/name_pair.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::velocity_scale_robots_test {

struct StockRobot {
  const char* urdf;
  const char* srdf;              ///< empty: none
  JointPositions ready;          ///< of its SRDF's group state; empty: none
  bool is_clear_at_rest = true;  ///< else links overlap there, or touch when they move on: no matter of distances
};

std::ostream& operator<<(std::ostream& stream, const StockRobot& robot) {
  return stream << robot.urdf;
}

class StockRobots : public ::testing::TestWithParam<StockRobot> {};

/// Sends the robot's pose for a while, each joint moving by `rate`, then measures.
CycleSafety measureAt(const RobotModel& robot, const JointPositions& at, double rate, MonitorLoop& loop,
                      ProximityMeasure& measure) {
  loop.reset();
  for (int i = 0; i < 12; ++i) {
    const double now = 10.0 + 0.02 * i;
    JointPositions positions;
    for (const std::string& link : robot.links()) {
      const int index = robot.find(link);
      if (robot.parent(index) < 0) continue;
      const urdf::Joint& joint = robot.jointAbove(index);
      if (joint.type == urdf::Joint::FIXED || joint.mimic) continue;
      const auto given = at.find(joint.name);
      positions[joint.name] = (given != at.end() ? given->second : robot.position(joint, {})) + rate * 0.02 * i;
    }
    const std::vector<Isometry3d> X_RL = robot.forwardKinematics(positions);
    std::vector<geometry_msgs::TransformStamped> transforms;
    for (std::size_t link = 1; link < X_RL.size(); ++link)
      transforms.push_back(test::stampedTransform(robot.root(), robot.links()[link], ros::Time(now),
                                                  Quaterniond(X_RL[link].linear()), X_RL[link].translation()));
    loop.history().add(test::message(transforms), false);
    ros::Time::setNow(ros::Time(now));
    if (loop.step(ros::Time(now), {}) == TfTracker::Step::kCycle) measure.measure(false);
  }
  return measure.safety();
}

TEST_P(StockRobots, MoveAtFullScaleInAnEmptyWorld) {
  const std::string urdf = "robots/" + std::string(GetParam().urdf);
  SDF_CCD_NEEDS_DATA(urdf);
  ::setenv("ROS_PACKAGE_PATH", test::dataPath("robots").c_str(), 1);
  ros::Time::init();
  MonitorParameters parameters = parseParameters({}, "~");
  parameters.proximity.promise = StoppingPromise();  // the defaults
  parameters.scene.cache_directory.clear();
  parameters.scene.shell.spacing = 0.05;  // only surfaces are needed here
  parameters.scene.points_across = parameters.scene.cells_across = 0.0;
  parameters.scene.field.cell_size = std::nullopt;
  parameters.scene.field.cells = 8;
  parameters.urdf = test::readText(test::dataPath(urdf));
  const std::string srdf = GetParam().srdf;
  if (!srdf.empty()) parameters.srdf = test::readText(test::dataPath("robots/" + srdf));
  const PackageFinder packages = packagesFromEnvironment();
  DescribedScene described =
      describeScene(parameters, [&](const std::string& uri) { return loadLocalResource(uri, packages, ""); });
  const ScenePlan plan = planScene(described.scene, planOptions(parameters.scene));
  const std::shared_ptr<const Scene> scene = buildDescribed(described, plan, parameters.scene, {});
  MonitorLoop loop(scene, described, parameters);
  ProximityMeasure measure(parameters.proximity, loop);
  const auto tell = [&](const CycleSafety& safety) {
    std::string text;
    setLimit(safety, *scene, measure.rules(), text);
    for (const int index : loop.result().not_clear) {
      const PairResult& pair = loop.result().pairs[index];
      text += "; " + pairName(*scene, pair) + " " + toString(pair.verdict) + " " + pair.reason;
    }
    return text;
  };

  std::vector<JointPositions> poses = {{}};
  if (!GetParam().ready.empty()) poses.push_back(GetParam().ready);
  for (const JointPositions& pose : poses) {
    const CycleSafety at_rest = measureAt(*described.robot, pose, 0.0, loop, measure);
    // Whatever touches there, no pair that does not touch limits the scale.
    std::vector<PairDistance> apart = loop.distances();
    apart.erase(std::remove_if(apart.begin(), apart.end(), [](const auto& pair) { return pair.any.width <= 0.0; }),
                apart.end());
    EXPECT_FALSE(loop.distances().empty());
    const ScaleLimits limits = velocityScales(apart, loop.traits(), 0.0, 0.0, 1.0, *parameters.proximity.promise);
    EXPECT_EQ(limits.promised.scale, 1.0);
    EXPECT_EQ(limits.measured.scale, 1.0);
    const bool is_clear = loop.result().verdict == Verdict::kClear;
    if (is_clear) {
      EXPECT_EQ(at_rest.velocity_scale, 1.0) << tell(at_rest);
    }
    if (!GetParam().is_clear_at_rest && pose.empty()) {
      if (!is_clear) std::cout << tell(at_rest) << std::endl;
      continue;
    }
    EXPECT_TRUE(is_clear) << tell(at_rest);
    const CycleSafety moving = measureAt(*described.robot, pose, 0.1, loop, measure);
    EXPECT_EQ(moving.velocity_scale, 1.0) << tell(moving);
  }
}

const JointPositions kPandaReady = {{"panda_joint1", 0.0},    {"panda_joint2", -0.785}, {"panda_joint3", 0.0},
                                    {"panda_joint4", -2.356}, {"panda_joint5", 0.0},    {"panda_joint6", 1.571},
                                    {"panda_joint7", 0.785}};
const JointPositions kKinovaUp = {{"j2s6s200_joint_1", 1.5707},  {"j2s6s200_joint_2", 2.618},
                                  {"j2s6s200_joint_3", -1.5707}, {"j2s6s200_joint_4", 3.1415},
                                  {"j2s6s200_joint_5", 2.618},   {"j2s6s200_joint_6", 0.0}};

INSTANTIATE_TEST_SUITE_P(
    All, StockRobots,
    ::testing::Values(
        StockRobot{"panda_from_xacro.urdf", "panda_moveit_config/config/panda.srdf", kPandaReady, false},
        StockRobot{"fanuc_description/urdf/fanuc.urdf", "fanuc_moveit_config/config/fanuc.srdf", {}},
        StockRobot{"example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
                   "example-robot-data/robots/ur_description/srdf/ur5.srdf",
                   {}},
        StockRobot{"example-robot-data/robots/ur_description/urdf/ur5_gripper.urdf",
                   "example-robot-data/robots/ur_description/srdf/ur5_gripper.srdf",
                   {}},
        StockRobot{"example-robot-data/robots/kinova_description/robots/kinova.urdf",
                   "example-robot-data/robots/kinova_description/srdf/kinova.srdf", kKinovaUp, false},
        StockRobot{"example-robot-data/robots/allegro_hand_description/urdf/allegro_left_hand.urdf", "", {}},
        StockRobot{"example-robot-data/robots/allegro_hand_description/urdf/allegro_right_hand.urdf", "", {}},
        StockRobot{"dual_panda_from_xacro.urdf", "", {}},
        StockRobot{"pr2_description/urdf/robot.xml", "pr2_description/srdf/robot.xml", {}, false},
        StockRobot{"pr2_calibrated/pr1012_urdf_1a0f5a3.urdf", "", {}, false},
        StockRobot{"pr2_calibrated/pr1012_urdf_67b1b5a5.urdf", "", {}, false}));

}  // namespace sdf_ccd::velocity_scale_robots_test
