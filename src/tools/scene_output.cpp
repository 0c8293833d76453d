#include "scene_output.h"

#include <iostream>

#include "progress_bar.h"

namespace sdf_ccd::tools {

void buildSceneWithBar(const std::function<void(const SceneProgress&)>& build, const Interrupt& interrupt) {
  ProgressBar bar("fields and shells");
  interrupt.during([&] { build([&](const std::string&, double share) { bar(share); }); });
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
