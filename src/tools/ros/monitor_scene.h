#pragma once

#include <memory>
#include <string>
#include <vector>

#include "interrupt.h"
#include "ros/world/describe_scene.h"

namespace sdf_ccd::tools {

/// Thrown out of the work when the user ends it; no std::exception, which would be one body's failure.
struct Interrupted {};

/// The robot and world that the parameters tell of; relative paths of the URDF at `urdf` start from its folder.
DescribedScene describeMonitored(const MonitorParameters& parameters, const std::string& urdf);

/// What the monitor builds at its start, with a progress bar. @throws Interrupted.
std::shared_ptr<const Scene> buildWithBar(const DescribedScene& described, const ScenePlan& plan,
                                          const BodyOptions& options, const Interrupt& interrupt);

/// Names on stderr the bodies that could not be made, which no cycle checks; whether there are none.
bool areAllMade(const Scene& scene);

/// The plan's table, and a line for each warning.
std::string planText(const Scene& scene, const std::vector<std::string>& warnings);

}  // namespace sdf_ccd::tools
