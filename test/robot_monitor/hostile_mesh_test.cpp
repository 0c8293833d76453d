#include <sys/resource.h>

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "oracle/files.h"
#include "oracle/hostile_files.h"
#include "oracle/parameter_name.h"
#include "sdf_ccd/monitor.h"
#include "sdf_ccd/robot.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::hostile_mesh_test {

const std::string kSource = SDF_CCD_SOURCE_DIR;

/// The demo's arm with another mesh for the forearm.
SceneDescription armWith(const std::string& forearm) {
  std::string urdf = test::readText(kSource + "/config/demo/arm.urdf");
  const std::string good = "package://sdf_ccd/config/demo/meshes/forearm.obj";
  for (std::size_t at = 0; (at = urdf.find(good, at)) != std::string::npos; at += forearm.size()) {
    urdf.replace(at, good.size(), forearm);
  }
  const ResourceLoader loader = [](const std::string& uri) {
    return loadLocalResource(
        uri, [](const std::string&) { return kSource; }, "");
  };
  std::vector<std::string> warnings;
  return describeRobot(RobotModel(urdf), {}, loader, {}, warnings);
}

SceneDescription goodArm() {
  return armWith("package://sdf_ccd/config/demo/meshes/forearm.obj");
}

/// CPU time of this process and of its terminated children, independent of the computer's other load [s].
double cpuSeconds() {
  double seconds = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage = {};
    getrusage(who, &usage);
    for (const timeval& part : {usage.ru_utime, usage.ru_stime})
      seconds += double(part.tv_sec) + 1e-6 * double(part.tv_usec);
  }
  return seconds;
}

double secondsWith(const std::string& forearm) {
  const double start = cpuSeconds();
  armWith(forearm);
  return cpuSeconds() - start;
}

class HostileMesh : public ::testing::TestWithParam<std::string> {};

TEST_P(HostileMesh, CostsItsLinkAlone) {
  const SceneDescription arm = armWith("file://" + test::hostilePath(GetParam()));
  ASSERT_EQ(arm.bodies.size(), goodArm().bodies.size());
  for (const BodyDescription& body : arm.bodies) {
    if (body.name == "forearm") {
      EXPECT_EQ(body.failure.rfind("link forearm: ", 0), 0u) << body.failure;
      EXPECT_NE(body.failure.find(GetParam()), std::string::npos) << body.failure;
      EXPECT_LT(body.failure.size(), 1000u);
    } else {
      EXPECT_EQ(body.failure, "") << body.name;
    }
  }

  BodyOptions options;
  options.field.cells = 8;
  options.shell.spacing = 0.05;
  const auto scene = std::make_shared<const Scene>(buildScene(arm, planScene(arm, planOptions(options)), options));
  Monitor monitor(scene, MonitorOptions());
  CycleMotion rest;
  rest.times = {0.0, 1.0};
  for (std::size_t i = 0; i < scene->bodies.size(); ++i) {
    Isometry3d X = Isometry3d::Identity();
    X.translation().x() = 10.0 * static_cast<double>(i);  // apart, so that checked pairs are CLEAR
    rest.X_WB.push_back({X, X});
  }
  const CycleResult& result = monitor.run(rest, {});
  EXPECT_EQ(result.verdict, Verdict::kNotChecked);
  for (const PairResult& pair : result.pairs) {
    const bool has_it = scene->bodies[pair.body_a].name == "forearm" || scene->bodies[pair.body_b].name == "forearm";
    EXPECT_EQ(pair.verdict, has_it ? Verdict::kNotChecked : Verdict::kClear);
    EXPECT_EQ(pair.reason.find(GetParam()) != std::string::npos, has_it) << pair.reason;
  }
  EXPECT_GT(result.checked, 0);
  EXPECT_GT(result.not_checked, 0);
}

TEST_P(HostileMesh, StartsNoLater) {
  double least = 1e9, least_of_good = 1e9;
  for (int run = 0; run < 9; ++run) {  // in turn, as what else the computer does slows both
    least = std::min(least, secondsWith("file://" + test::hostilePath(GetParam())));
    least_of_good = std::min(least_of_good, secondsWith("package://sdf_ccd/config/demo/meshes/forearm.obj"));
  }
  EXPECT_LT(least, least_of_good + 0.02);
}

INSTANTIATE_TEST_SUITE_P(Hostile, HostileMesh, ::testing::ValuesIn(test::hostileMeshes()), test::ParameterName());

TEST(HostileMesh, ThePrismIsWhole) {
  const SceneDescription arm = armWith("file://" + test::hostilePath("prism_12.off"));
  for (const BodyDescription& body : arm.bodies) EXPECT_EQ(body.failure, "");
}

}  // namespace sdf_ccd::hostile_mesh_test
