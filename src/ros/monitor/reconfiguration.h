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

/// What clients of dynamic_reconfigure have set in one namespace. What cannot be is refused as a whole: then the answer
/// says what stays.
template <class Config>
class ConfigServer {
 public:
  /// @param start  what holds at first, whatever the parameter server says.
  /// @param why_not  empty if a configuration can be.
  /// @param changed  called when another one has been set, by the thread that serves.
  ConfigServer(const ros::NodeHandle& node, const Config& start, std::function<std::string(const Config&)> why_not,
               std::function<void()> changed);

  /// What has been set since this was asked last.
  std::optional<Config> take();

 private:
  void set(Config& config);

  std::mutex mutex_;
  Config in_force_;
  bool begins_ = true;
  bool is_new_ = false;
  std::function<std::string(const Config&)> why_not_;
  std::function<void()> changed_;
  dynamic_reconfigure::Server<Config> server_;
};

/// What of the parameters may change while the monitor runs (cfg/): rate and budget, nearness, what is listed and how
/// it is drawn.
///
/// Serves, below the node's name, as dynamic_reconfigure does, with its topics parameter_descriptions and
/// parameter_updates:
///   set_parameters  dynamic_reconfigure/Reconfigure
///   velocity_scale/set_parameters  the same, of the promise that the velocity scale rests on, if there is one
class Reconfiguration {
 public:
  /// @param changed  called when anything has been set, by the thread that serves.
  Reconfiguration(const ros::NodeHandle& private_node, const MonitorParameters& parameters,
                  const std::function<void()>& changed);

  /// Sets what has been set since it was asked last. @return whether anything has.
  bool apply(MonitorParameters& parameters);

 private:
  ConfigServer<CollisionMonitorConfig> monitor_;
  std::unique_ptr<ConfigServer<VelocityScaleConfig>> velocity_scale_;
};

}  // namespace sdf_ccd
