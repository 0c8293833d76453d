#pragma once

#include <string>

#include "monitor_config.h"

namespace sdf_ccd::tools {

/// Builds everything that the monitor would build at start-up with these parameters, in a directory that the monitor
/// can use as its cache; a copy of the directory serves too.
/// @throws std::runtime_error if the directory cannot be written; PartlyDone if some bodies cannot be built.
void prepareRobot(const MonitorConfig& config, const std::string& directory);

}  // namespace sdf_ccd::tools
