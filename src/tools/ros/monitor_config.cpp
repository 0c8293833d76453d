#include "monitor_config.h"

#include <stdexcept>

#include "ros/parameters/yaml_parameters.h"
#include "tools/read_text.h"

namespace sdf_ccd::tools {
namespace {

/// The parameter tree, overridden by the options.
XmlRpc::XmlRpcValue parameterTree(const MonitorConfig& config) {
  XmlRpc::XmlRpcValue tree;
  if (!config.parameters.empty()) tree = loadYamlParameters(config.parameters);
  if (config.rate) tree["rate"] = *config.rate;
  if (config.max_error) tree["max_error"] = *config.max_error;
  return tree;
}

}  // namespace

MonitorParameters readParameters(const MonitorConfig& config) {
  const std::string prefix = config.parameters.empty() ? "" : config.parameters + ": ";
  const XmlRpc::XmlRpcValue tree = parameterTree(config);
  MonitorParameters parameters;
  try {
    parameters = parseParameters(tree, "~");
  } catch (const ParameterError& error) {
    throw std::runtime_error(prefix + error.what());
  }
  parameters.urdf = readText(config.urdf);
  if (!config.srdf.empty()) parameters.srdf = readText(config.srdf);
  parameters.urdf_source = config.urdf;
  parameters.srdf_source = config.srdf;
  if (!parameters.unknown.empty()) {
    throw std::runtime_error(prefix + "unknown parameter " + parameters.unknown.front());
  }
  return parameters;
}

}  // namespace sdf_ccd::tools
