#include <algorithm>
#include <cstdlib>
#include <string>

#include "oracle/files.h"
#include "oracle/parameter_name.h"
#include "oracle/test_data.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::real_robots_test {

struct RealRobot {
  const char* urdf;
  const char* srdf;  ///< empty: no SRDF
  std::size_t bodies;
  std::size_t left_out;  ///< disabled by the SRDF, rigidly joined or adjacent
  std::size_t pairs;
};

std::ostream& operator<<(std::ostream& stream, const RealRobot& robot) {
  return stream << robot.urdf;
}

const std::string kExample = "robots/example-robot-data/robots/";

class RealRobots : public ::testing::TestWithParam<RealRobot> {};

TEST_P(RealRobots, LoadWithoutFailureOrWarning) {
  const std::string urdf = "robots/" + std::string(GetParam().urdf);
  SDF_CCD_NEEDS_DATA(urdf);
  ::setenv("ROS_PACKAGE_PATH", test::dataPath("robots").c_str(), 1);
  const PackageFinder packages = packagesFromEnvironment();
  const ResourceLoader loader = [&](const std::string& uri) { return loadLocalResource(uri, packages, ""); };
  const std::string srdf = GetParam().srdf;

  ::testing::internal::CaptureStderr();
  const std::string text = test::readText(test::dataPath(urdf));
  const bool has_macros = text.find("<xacro:") != std::string::npos;  // of gazebo's, in a calibrated PR2
  const RobotModel robot(text);
  std::vector<std::string> warnings;
  const Srdf parsed = srdf.empty() ? Srdf() : parseSrdf(test::readText(test::dataPath("robots/" + srdf)));
  const SceneDescription scene = describeRobot(robot, parsed, loader, {}, warnings);
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");

  for (const BodyDescription& body : scene.bodies) EXPECT_EQ(body.failure, "");
  for (const std::string& warning : warnings) {
    if (has_macros && warning.find("xacro has not expanded") != std::string::npos) continue;
    if (scene.visual_only.empty() || warning.find("a visual but no collision shape") == std::string::npos) {
      ADD_FAILURE() << warning;
    }
  }
  EXPECT_EQ(scene.bodies.size(), GetParam().bodies);
  const ScenePlan plan = planScene(scene);
  EXPECT_EQ(plan.left_out.size(), GetParam().left_out);
  EXPECT_EQ(plan.pairs.size(), GetParam().pairs);
}

INSTANTIATE_TEST_SUITE_P(
    All, RealRobots,
    ::testing::Values(
        RealRobot{"panda_from_xacro.urdf", "panda_moveit_config/config/panda.srdf", 11, 34, 21},
        RealRobot{"dual_panda_from_xacro.urdf", "", 23, 23, 230},
        RealRobot{"fanuc_description/urdf/fanuc.urdf", "fanuc_moveit_config/config/fanuc.srdf", 7, 10, 11},
        RealRobot{"pr2_description/urdf/robot.xml", "pr2_description/srdf/robot.xml", 54, 66, 1365},
        RealRobot{"pr2_calibrated/pr1012_urdf_1a0f5a3.urdf", "", 51, 54, 1221},
        RealRobot{"pr2_calibrated/pr1012_urdf_67b1b5a5.urdf", "", 51, 54, 1221},
        RealRobot{"example-robot-data/robots/ur_description/urdf/ur5_robot.urdf",
                  "example-robot-data/robots/ur_description/srdf/ur5.srdf", 8, 11, 17},
        RealRobot{"example-robot-data/robots/kinova_description/robots/kinova.urdf",
                  "example-robot-data/robots/kinova_description/srdf/kinova.srdf", 11, 16, 39},
        RealRobot{"example-robot-data/robots/allegro_hand_description/urdf/allegro_left_hand.urdf", "", 21, 20, 190},
        RealRobot{"example-robot-data/robots/allegro_hand_description/urdf/allegro_right_hand.urdf", "", 21, 20, 190}),
    test::ParameterName());

}  // namespace sdf_ccd::real_robots_test
