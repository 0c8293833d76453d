// Whether two bodies touch while both of them move, although they are apart at the start and at the end.
#include <cstdio>
#include <memory>

#include <sdf_ccd/scene/monitor.h>
#include <sdf_ccd/scene/scene_plan.h>

namespace {

using namespace sdf_ccd;

BodyDescription box(const std::string& name, const Vector3d& half_size) {
  BodyDescription body;
  body.name = body.frame = name;
  body.geometry.push_back({Primitive(Box{half_size}), Isometry3d::Identity(), "box"});
  return body;
}

Isometry3d at(double x, double y) {
  return Isometry3d(Eigen::Translation3d(x, y, 0.0));
}

}  // namespace

int main() {
  // A plate of 1 mm and a rod, whose ends are known before and after they have passed each other.
  const SceneDescription description{{box("plate", {0.2, 0.0005, 0.2}), box("rod", {0.01, 0.05, 0.01})}, {}};
  SceneOptions options;
  options.field.max_error = 1e-4;
  options.shell.spacing = 0.01;
  auto scene = std::make_shared<const Scene>(buildScene(description, planScene(description), options));
  Monitor monitor(scene, {});

  CycleMotion motion;
  motion.times = {0.0, 0.1};  // [s]
  motion.X_WB = {{at(0.0, 0.2), at(0.0, -0.2)}, {at(0.0, -0.2), at(0.0, 0.2)}};
  const CycleResult& result = monitor.run(motion, {});
  std::printf("%s, within %.2g m\n", toString(result.verdict), result.error_bound);
  for (const PairResult& pair : result.pairs)
    for (const Interval& interval : pair.intervals)
      std::printf("%s - %s: in contact from %.4f s to %.4f s, %.2g m deep\n", scene->bodies[pair.body_a].name.c_str(),
                  scene->bodies[pair.body_b].name.c_str(), interval.enter, interval.exit, pair.deepest.depth);
  return result.verdict == Verdict::kContact ? 0 : 1;
}
