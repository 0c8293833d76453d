// Checks a robot's trajectory for contact with the world and with itself, also between its waypoints.
#include <cstdio>
#include <memory>

#include <sdf_ccd/body/prepare_body.h>
#include <sdf_ccd/robot/robot_scene.h>
#include <sdf_ccd/robot_monitor/check_motion.h>

namespace {

const char* const kArm = R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.2 0.2 0.1"/></geometry></collision></link>
  <link name="upper"><collision><origin xyz="0 0 0.25"/><geometry><box size="0.05 0.05 0.4"/></geometry></collision></link>
  <link name="fore"><collision><origin xyz="0 0 0.2"/><geometry><box size="0.04 0.04 0.36"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="fore"/><origin xyz="0 0 0.5"/>
    <axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
</robot>)";

}  // namespace

int main() {
  using namespace sdf_ccd;
  const RobotModel robot(kArm);
  std::vector<std::string> warnings;
  SceneDescription description = describeRobot(robot, {}, {}, {}, warnings);
  BodyDescription post;  // between the trajectory's two ends
  post.name = "post";
  post.frame = robot.root();
  post.X_frame_B = Eigen::Translation3d(0.6, 0.0, 0.6);
  post.geometry.push_back({Primitive(Cylinder{0.02, 0.1}), Isometry3d::Identity(), "cylinder"});
  post.is_world = true;
  description.bodies.push_back(post);

  const BodyOptions options = optionsFor({1e-3, {}});
  const auto scene =
      std::make_shared<const Scene>(buildScene(description, planScene(description, planOptions(options)), options));

  RobotTrajectory trajectory;
  trajectory.times = {0.0, 2.0};  // [s]
  trajectory.states.resize(2);
  trajectory.states[0].positions = {{"shoulder", 0.0}, {"elbow", 0.0}};
  trajectory.states[1].positions = {{"shoulder", 1.5}, {"elbow", 0.0}};
  const PlannedMotion motion = planAlong(robot, completePlan(robot, trajectory, {}, {}), bodiesOf(*scene, robot));
  const CycleResult result = checkMotion(scene, {}, motion);

  std::printf("%s, within %.2g m\n", toString(result.verdict), result.error_bound);
  for (const PairResult& pair : result.pairs)
    for (const Interval& interval : pair.intervals)
      std::printf("%s - %s: from %.3f s to %.3f s\n", scene->bodies[pair.body_a].name.c_str(),
                  scene->bodies[pair.body_b].name.c_str(), interval.enter, interval.exit);
  return result.verdict == Verdict::kContact ? 0 : 1;
}
