#include "read_text.h"

#include <filesystem>
#include <stdexcept>

#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd::tools {

std::string readText(const std::string& path) {
  const std::string text = loadLocalResource(path, nullptr, std::filesystem::current_path().string()).bytes;
  if (text.empty()) throw std::runtime_error(path + ": is empty");
  return text;
}

}  // namespace sdf_ccd::tools
