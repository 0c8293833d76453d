#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <dynamic_reconfigure/server.h>
#include <ros/node_handle.h>

#include "ros/parameters/parameters.h"
#include "sdf_ccd/CollisionMonitorConfig.h"
#include "sdf_ccd/VelocityScaleConfig.h"

namespace sdf_ccd {

/// The values set by clients of dynamic_reconfigure in one namespace. An invalid configuration, or one that is not
/// permitted, is refused as a whole: the response then holds the present values, and the log says why.
template <class Config>
class ConfigServer {
 public:
  /// @param start  the first values, whatever the parameter server holds.
  /// @param why_invalid  returns why a configuration is refused; empty if it is not.
  /// @param changed  called by the serving thread when new values have been set.
  ConfigServer(const ros::NodeHandle& node, const Config& start, std::function<std::string(const Config&)> why_invalid,
               std::function<void()> changed);

  /// The values set since the last call.
  std::optional<Config> changes();

 private:
  void set(Config& config);

  std::mutex mutex_;
  Config current_;
  bool is_first_call_ = true;
  bool has_changed_ = false;
  std::function<std::string(const Config&)> why_invalid_;
  std::function<void()> changed_;
  dynamic_reconfigure::Server<Config> server_;
};

/// The parameters that can change while the monitor runs (cfg/): rate and time budget, distances, output and markers.
/// What limits the robot can be set to the safe side of the start-up parameters only, unless requests/allow holds
/// limits.
///
/// Serves, below the node's name, as dynamic_reconfigure does, with its topics parameter_descriptions and
/// parameter_updates:
///   set_parameters  dynamic_reconfigure/Reconfigure
///   velocity_scale/set_parameters  the same for the limits of the robot that obeys the velocity scale, if it is used
class Reconfiguration {
 public:
  /// @param changed  called by the serving thread when new values have been set.
  Reconfiguration(const ros::NodeHandle& private_node, const MonitorParameters& parameters,
                  const std::function<void()>& changed);

  /// Copies the values set since the last call to `parameters`. @return whether there were any.
  bool apply(MonitorParameters& parameters);

 private:
  ConfigServer<CollisionMonitorConfig> monitor_;
  std::unique_ptr<ConfigServer<VelocityScaleConfig>> velocity_scale_;
};

}  // namespace sdf_ccd
