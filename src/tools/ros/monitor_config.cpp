#include "monitor_config.h"

#include <stdexcept>

#include "common/settings/yaml_settings.h"
#include "robot/robot_files.h"

namespace sdf_ccd::tools {
namespace {

/// The parameter tree, overridden by the options.
Setting parameterTree(const MonitorConfig& config) {
  Setting tree = config.parameters.empty() ? Setting() : loadYaml(config.parameters);
  auto& group = std::get<Setting::Group>(tree.value);
  if (config.rate) group["rate"] = {*config.rate};
  if (config.max_error) group["max_error"] = {*config.max_error};
  return tree;
}

}  // namespace

MonitorParameters readParameters(const MonitorConfig& config) {
  const std::string prefix = config.parameters.empty() ? "" : config.parameters + ": ";
  const Setting tree = parameterTree(config);
  MonitorParameters parameters;
  try {
    parameters = parseParameters(tree, "~");
  } catch (const std::exception& error) {
    throw std::runtime_error(prefix + error.what());
  }
  parameters.urdf = readTextFile(config.urdf);
  if (!config.srdf.empty()) parameters.srdf = readTextFile(config.srdf);
  parameters.urdf_source = config.urdf;
  parameters.srdf_source = config.srdf;
  if (!parameters.unused.empty()) throw std::runtime_error(prefix + "unknown parameter " + parameters.unused.front());
  return parameters;
}

}  // namespace sdf_ccd::tools
