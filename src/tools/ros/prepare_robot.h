#pragma once

#include <string>

#include "monitor_config.h"

namespace sdf_ccd::tools {

/// Makes all that the monitor would make at its start for these parameters, and keeps it in a directory that the
/// monitor takes for its cache: here, or where it is copied to.
/// @throws std::runtime_error if nothing can be kept there; PartlyDone if some bodies cannot be built.
void prepareRobot(const MonitorConfig& config, const std::string& directory);

}  // namespace sdf_ccd::tools
