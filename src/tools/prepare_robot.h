#pragma once

#include <optional>
#include <string>

#include "resolution_options.h"

namespace sdf_ccd::tools {

/// A robot's files, and parameters that differ from the monitor's defaults.
struct RobotFiles {
  std::string urdf, srdf;         ///< no SRDF if empty
  FieldOptions field;             ///< without a resolution: that of the monitor
  std::optional<double> spacing;  ///< of the shells' points [m]
  double max_time;                ///< BodyOptions::max_preparation_time [s]
};

/// prepareScene() of a robot without a world. @throws as prepareScene(), and std::runtime_error if a file is bad.
void prepareRobot(const RobotFiles& files, const std::string& directory);

}  // namespace sdf_ccd::tools
