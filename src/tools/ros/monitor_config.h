#pragma once

#include <optional>
#include <string>

#include "ros/parameters/parameters.h"

namespace sdf_ccd::tools {

/// The monitor's parameters from files, and the options that override them.
struct MonitorConfig {
  std::string urdf, srdf;           ///< files; no SRDF if empty
  std::string parameters;           ///< file, as config/monitor.yaml; defaults if empty
  std::optional<double> rate;       ///< [Hz]
  std::optional<double> max_error;  ///< [m]
};

/// Reads the files and applies the options. An unknown parameter is an error here; on a parameter server it may belong
/// to another node.
/// @throws std::runtime_error that names the file, or the parameter and its value.
MonitorParameters readParameters(const MonitorConfig& config);

}  // namespace sdf_ccd::tools
