#include "robot_files.h"

#include <filesystem>
#include <stdexcept>

namespace sdf_ccd {

std::string readTextFile(const std::string& path) {
  const std::string text = loadLocalResource(path, nullptr, std::filesystem::current_path().string()).bytes;
  if (text.empty()) throw std::runtime_error(path + ": is empty");
  return text;
}

LoadedRobot loadRobot(const std::string& urdf, const std::string& srdf) {
  LoadedRobot robot{RobotModel(readTextFile(urdf), urdf), srdf.empty() ? "" : readTextFile(srdf), {}, {}};
  if (!srdf.empty()) robot.srdf = parseSrdf(robot.srdf_text, srdf);
  robot.loader = localLoader(std::filesystem::absolute(urdf).parent_path().string());
  return robot;
}

ResourceLoader localLoader(const std::string& base_directory) {
  return [packages = packagesFromEnvironment(), base_directory](const std::string& uri) {
    return loadLocalResource(uri, packages, base_directory);
  };
}

}  // namespace sdf_ccd
