#include "ros/parameters/world_file.h"

#include <filesystem>
#include <stdexcept>

#include "common/files/regular_file.h"
#include "common/settings/yaml_settings.h"
#include "common/text_limits.h"
#include "robot/moveit_scene.h"
#include "ros/parameters/world_parameters.h"

namespace sdf_ccd {

std::vector<WorldObject> loadWorldFile(const std::string& file) {
  return parseWorldFile(readNamedFile(file, kMaxYamlBytes), file);
}

std::vector<WorldObject> parseWorldFile(const std::string& text, const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  try {
    if (ending == ".yaml" || ending == ".yml") {
      SettingsReader reader(parseYaml(text), "");
      if (!reader.has("world")) throw std::runtime_error("there is no `world` in it");
      return readWorld(reader);
    }
    if (ending != ".scene") throw std::runtime_error("a world's file must end in .yaml, .yml or .scene");
    return parseMoveitScene(text);
  } catch (const std::exception& error) {
    throw std::runtime_error(file + ": " + error.what());
  }
}

}  // namespace sdf_ccd
