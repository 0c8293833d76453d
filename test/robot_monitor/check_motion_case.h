#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "motion/motion_sampling.h"
#include "robot/planned_motion.h"
#include "robot_monitor/check_motion.h"
#include "sdf_ccd/body.h"
#include "sdf_ccd/robot.h"

namespace sdf_ccd::test {

/// A rod of 1 m that rotates about z at the origin.
constexpr const char* kRod = R"(<robot name='r'>
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
    return planAlong(robot_, completePlan(robot_, trajectory, {}, {}), bodiesOf(scene, robot_), sampling);
  }

  const RobotModel robot_{kRod};
};

}  // namespace sdf_ccd::test
