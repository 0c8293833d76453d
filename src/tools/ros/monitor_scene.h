#pragma once

#include <string>

#include "monitor_config.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd::tools {

/// Describes the robot and world of the parameters. Relative paths in the URDF are resolved from the folder of `urdf`.
DescribedScene describeMonitored(const MonitorParameters& parameters, const std::string& urdf);

/// prepareScene() of the robot and world of the parameters. @throws as prepareScene() and readParameters().
void prepareMonitored(const MonitorConfig& config, const std::string& directory);

}  // namespace sdf_ccd::tools
