#include "monitor_scene.h"

#include <filesystem>
#include <iostream>

#include "progress_bar.h"

namespace sdf_ccd::tools {

DescribedScene describeMonitored(const MonitorParameters& parameters, const std::string& urdf) {
  const std::string directory = std::filesystem::absolute(urdf).parent_path().string();
  return describeScene(parameters, makeResourceLoader(packagesFromEnvironment(), directory, parameters.allow_http));
}

std::shared_ptr<const Scene> buildWithBar(const DescribedScene& described, const ScenePlan& plan,
                                          const BodyOptions& options, const Interrupt& interrupt) {
  ProgressBar bar("fields and shells");
  std::shared_ptr<const Scene> scene;
  interrupt.during(
      [&] { scene = buildDescribed(described, plan, options, [&](const std::string&, double share) { bar(share); }); });
  return scene;
}

bool areAllMade(const Scene& scene) {
  bool are_made = true;
  for (const Body& body : scene.bodies) {
    if (body.failure.empty() || !body.map.empty()) continue;  // a map's body is built when the first map arrives
    std::cerr << "sdf_ccd: not checked: " << body.failure << std::endl;
    are_made = false;
  }
  return are_made;
}

std::string planText(const Scene& scene, const std::vector<std::string>& warnings) {
  std::string text = planTable(scene);
  for (const std::string& warning : warnings) text += "warning: " + warning + "\n";
  return text;
}

}  // namespace sdf_ccd::tools
