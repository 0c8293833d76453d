#include "monitor_scene.h"

#include <filesystem>

#include "tools/prepare_scene.h"

namespace sdf_ccd::tools {

DescribedScene describeMonitored(const MonitorParameters& parameters, const std::string& urdf) {
  const std::string directory = std::filesystem::absolute(urdf).parent_path().string();
  const PackageFinder packages = packagesFromEnvironment();
  return describeScene(parameters, [&](const std::string& uri) { return loadLocalResource(uri, packages, directory); });
}

void prepareMonitored(const MonitorConfig& config, const std::string& directory) {
  const MonitorParameters parameters = readParameters(config);
  DescribedScene described = describeMonitored(parameters, config.urdf);
  const auto build = [&](const ScenePlan& plan, const BodyOptions& options, const SceneProgress& progress) {
    return buildDescribed(described, plan, options, progress);
  };
  prepareScene({described.scene, parameters.scene, build, described.warnings, " and the same parameters"}, directory);
}

}  // namespace sdf_ccd::tools
