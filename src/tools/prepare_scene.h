#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "scene_output.h"

namespace sdf_ccd::tools {

/// What a monitor would build at start-up.
struct Preparation {
  SceneDescription scene;
  BodyOptions options;  ///< without cache directory
  std::function<std::shared_ptr<const Scene>(const ScenePlan&, const BodyOptions&, const SceneProgress&)> build;
  std::vector<std::string> warnings;
  std::string parameters;  ///< those with which a monitor loads the files, for the user
};

/// Builds everything that the monitor would build, in a directory that the monitor can use as its cache; a copy of the
/// directory serves too. Reports on the scene and on the files.
/// @throws std::runtime_error if the directory cannot be written; PartlyDone if some bodies cannot be built.
void prepareScene(const Preparation& preparation, const std::string& directory);

}  // namespace sdf_ccd::tools
