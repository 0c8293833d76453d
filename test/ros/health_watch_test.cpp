#include "ros/monitor/health_watch.h"

#include <gtest/gtest.h>

#include "monitor/voxel_mask.h"
#include "oracle/shapes.h"
#include "sdf_ccd/sdf_ccd.h"

namespace sdf_ccd {
namespace {

/// The warnings of a start-up.
std::vector<std::string> warningsOf(const Scene& scene, const MonitorParameters& parameters) {
  HealthWatch watch;
  watch.recordScene(scene, DescribedScene(), parameters);
  return watch.health().warnings;
}

TEST(HealthWatch, AStopDistanceWithinWhatMasksHideIsWarnedOf) {
  Scene spheres, meshes;
  spheres.bodies = BodyList({prepareBody("ball", Sphere{0.1}, Accuracy{0.01})});
  meshes.bodies = BodyList({prepareBody("ring", test::torusMesh(0.2, 0.06, 32, 16), Accuracy{0.01})});
  ASSERT_EQ(maskError(spheres), 0.0);
  const double error = maskError(meshes);
  ASSERT_GT(error, 0.005);
  MonitorParameters parameters = parseParameters({}, "~");
  StoppingPromise& promise = parameters.proximity.promise.emplace();
  parameters.live_map.padding = 0.5 * error;

  promise.stop_distance = 0.0;
  EXPECT_TRUE(warningsOf(meshes, parameters).empty()) << "no live map";
  parameters.live_map.topic = "/octomap";
  ASSERT_EQ(warningsOf(meshes, parameters).size(), 1u);
  EXPECT_NE(warningsOf(meshes, parameters)[0].find("set stop_distance to more"), std::string::npos);
  promise.stop_distance = 0.9 * error;
  EXPECT_EQ(warningsOf(meshes, parameters).size(), 1u) << "within the field's error";
  EXPECT_TRUE(warningsOf(spheres, parameters).empty()) << "exact, beyond the padding";
  promise.stop_distance = 1.01 * error;
  EXPECT_TRUE(warningsOf(meshes, parameters).empty());
  parameters.live_map.padding = 1.1 * error;
  EXPECT_EQ(warningsOf(spheres, parameters).size(), 1u) << "within the padding";
  parameters.proximity.promise.reset();
  EXPECT_TRUE(warningsOf(spheres, parameters).empty()) << "no promise";
}

}  // namespace
}  // namespace sdf_ccd
