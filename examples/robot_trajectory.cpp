// Checks a robot's trajectory for contact with the world and with itself, also between its waypoints.
#include <cstdio>

#include <sdf_ccd/robot_scene.h>

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
  WorldObject post;  // between the trajectory's two ends
  post.name = "post";
  post.X_frame_B = Eigen::Translation3d(0.6, 0.0, 0.6);
  post.shapes.push_back({Cylinder::fromRadiusAndLength(0.02, 0.2)});
  const RobotScene scene = RobotScene::parse(kArm, {}, {post});  // RobotScene::load() reads files
  for (const std::string& warning : scene.warnings()) std::printf("warning: %s\n", warning.c_str());

  const RobotTrajectory trajectory = splined({"shoulder", "elbow"}, {{0.0, {0.0, 0.0}}, {2.0, {1.5, 0.0}}}, 1e-4);
  const MotionResult result = scene.check(trajectory);
  std::printf("%s, within %.2g m\n", toString(result.verdict), result.error_bound);
  for (const MotionPair& pair : result.pairs)
    for (const Interval& contact : pair.contacts)
      std::printf("%s - %s: from %.3f s to %.3f s, %.4f m deep\n", pair.body_a.c_str(), pair.body_b.c_str(),
                  contact.enter, contact.exit, pair.deepest.depth);

  const BodyDistance nearest = scene.distance({{"shoulder", 0.0}, {"elbow", 0.0}});
  std::printf("at the start: %s - %s, %.4f m apart\n", nearest.body_a.c_str(), nearest.body_b.c_str(),
              nearest.distance);
  return result.verdict == Verdict::kContact && nearest.verdict == Verdict::kClear ? 0 : 1;
}
