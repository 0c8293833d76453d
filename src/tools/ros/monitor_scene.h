#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interrupt.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd::tools {

/// Describes the robot and world of the parameters. Relative paths in the URDF are resolved from the folder of `urdf`.
DescribedScene describeMonitored(const MonitorParameters& parameters, const std::string& urdf);

/// Builds the scene as the monitor does at start-up, with a progress bar. @throws Interrupted.
std::shared_ptr<const Scene> buildWithBar(const DescribedScene& described, const ScenePlan& plan,
                                          const BodyOptions& options, const Interrupt& interrupt);

/// Prints the bodies that could not be built, which no cycle checks, to stderr. @return true if there are none.
bool areAllMade(const Scene& scene);

/// The plan's table, and a line for each warning.
std::string planText(const Scene& scene, const std::vector<std::string>& warnings);

}  // namespace sdf_ccd::tools
