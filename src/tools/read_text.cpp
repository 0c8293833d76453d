#include "read_text.h"

#include <stdexcept>

#include "sdf_ccd/robot/robot_scene.h"

namespace sdf_ccd::tools {

std::string readText(const std::string& path) {
  const std::string text = loadLocalResource(path, nullptr, "").bytes;
  if (text.empty()) throw std::runtime_error(path + ": is empty");
  return text;
}

}  // namespace sdf_ccd::tools
