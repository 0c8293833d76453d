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

/// Reads them. An unknown parameter, which on a parameter server may be another node's, is an error in a file.
/// @throws std::runtime_error that names the file, or the parameter and its value.
MonitorParameters readParameters(const MonitorConfig& config);

}  // namespace sdf_ccd::tools
