#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interrupt.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd::tools {

/// Thrown when the user interrupts the work; no std::exception, which would count as one body's failure.
struct Interrupted {};

/// The robot and world of the parameters; relative paths of the URDF at `urdf` start from its folder.
DescribedScene describeMonitored(const MonitorParameters& parameters, const std::string& urdf);

/// Builds the scene as the monitor does at start-up, with a progress bar. @throws Interrupted.
std::shared_ptr<const Scene> buildWithBar(const DescribedScene& described, const ScenePlan& plan,
                                          const BodyOptions& options, const Interrupt& interrupt);

/// Prints the bodies that could not be built, which no cycle checks, to stderr; true if there are none.
bool areAllMade(const Scene& scene);

/// The plan's table, and a line for each warning.
std::string planText(const Scene& scene, const std::vector<std::string>& warnings);

}  // namespace sdf_ccd::tools
