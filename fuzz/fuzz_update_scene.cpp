// Fuzzes requests to update_scene, builds the resulting worlds, and runs cycles in them.
#include <limits>

#include "ros/world/apply_change.h"
#include "small_monitor.h"

namespace sdf_ccd::fuzz {
namespace {

std::string objectOf(Numbers& numbers) {
  static const std::vector<std::string> kNames = {"box", "ball", "f*", "?ox", "*", "new/1", "arm"};
  return numbers.below(2) == 0 ? nameOf(numbers) : kNames[numbers.below(kNames.size())];
}

geometry_msgs::Pose poseOf(Numbers& numbers) {
  geometry_msgs::Pose pose;
  if (numbers.below(3) > 0) takePose(numbers, pose.orientation, pose.position);
  return pose;
}

void addShapes(Numbers& numbers, SceneChange& change) {
  for (std::size_t i = numbers.below(3); i > 0; --i) {
    shape_msgs::SolidPrimitive primitive;
    primitive.type = numbers.below(6);
    for (std::size_t k = numbers.below(5); k > 0; --k) primitive.dimensions.push_back(numbers.real());
    change.primitives.push_back(primitive);
    if (numbers.below(2) == 0) change.primitive_poses.push_back(poseOf(numbers));
  }
  if (numbers.below(8) == 0) {
    shape_msgs::Plane plane;
    for (double& value : plane.coef) value = numbers.real();
    change.planes.push_back(plane);
  }
  if (numbers.below(4) == 0) {
    shape_msgs::Mesh mesh;
    for (std::size_t i = numbers.below(6); i > 0; --i) {
      geometry_msgs::Point p;
      p.x = numbers.real();
      p.y = numbers.real();
      p.z = numbers.real();
      mesh.vertices.push_back(p);
    }
    for (std::size_t i = numbers.below(6); i > 0; --i) {
      shape_msgs::MeshTriangle triangle;
      for (auto& corner : triangle.vertex_indices) corner = static_cast<std::uint32_t>(numbers.below(8));
      mesh.triangles.push_back(triangle);
    }
    change.meshes.push_back(mesh);
  }
  if (numbers.below(16) == 0) change.mesh_resources.push_back("file:///etc/passwd");
  if (numbers.below(16) == 0) change.octomap_file = "/dev/zero";
}

SceneChange changeOf(Numbers& numbers) {
  SceneChange change;
  change.operation = numbers.below(11);
  change.id = objectOf(numbers);
  if (numbers.below(2) == 0) change.header.frame_id = nameOf(numbers);
  change.pose = poseOf(numbers);
  addShapes(numbers, change);
  change.link_name = nameOf(numbers);
  for (std::size_t i = numbers.below(3); i > 0; --i) change.touch_links.push_back(objectOf(numbers));
  change.body_a = objectOf(numbers);
  change.body_b = objectOf(numbers);
  if (numbers.below(16) == 0) change.file = "../../etc/passwd";
  return change;
}

void checkText(const ChangingScene& scene, const ChangeSources& sources) {
  attempt([&] {
    std::vector<std::string> warnings;
    require(!sceneText(scene, sources.history, warnings).empty(), "a scene has a text");
  });
}

}  // namespace
}  // namespace sdf_ccd::fuzz

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace sdf_ccd;
  static fuzz::SmallMonitor monitor;
  static const RequestFiles files({}, [](const std::string&) { return Resource(); });
  fuzz::Numbers numbers(data, size);
  monitor.begin();
  MonitorLoop& loop = monitor.loop();
  const std::unique_ptr<WorldEditor> editor = monitor.editor();
  ChangingScene scene = monitor.changingScene();
  RequestLimits limits;
  limits.objects = 20;
  double now = fuzz::SmallMonitor::kStart;
  for (int call = 0; call < 4 && !numbers.done(); ++call) {
    fuzz::attempt([&] {
      ChangingScene next = scene;
      ChangeSources sources{loop.history(), files, limits, 1000, {}};
      for (std::size_t i = numbers.below(4); i > 0; --i) apply(fuzz::changeOf(numbers), sources, next);
      fuzz::checkText(next, sources);
      const auto world = std::make_shared<const CheckedWorld>(editor->next(next.description(limits)));
      scene = std::move(next);
      loop.adopt(*loop.prepare(world));
      fuzz::require(loop.world() == world, "the cycles go on in the new world");
    });
    now += 0.1;
    for (const char* link : {"arm", "hand", "ball"})
      loop.history().add(
          test::message({test::stampedTransform(std::string(link) == "hand" ? "arm" : "base", link, now, 0.2)}), false);
    if (loop.step(ros::Time(now), {}) != TfTracker::Step::kCycle) continue;
    fuzz::require(loop.result().pairs.size() == loop.scene().pairs.size(), "each pair has a result");
    fuzz::require(!std::isnan(loop.result().error_bound), "the error is a number");
  }
  return 0;
}
