#pragma once

#include <functional>
#include <string>
#include <vector>

#include "interrupt.h"
#include "sdf_ccd/scene.h"

namespace sdf_ccd::tools {

/// Called with the body's name and the share of all bodies done.
using SceneProgress = std::function<void(const std::string&, double)>;

/// Calls `build`, with a progress bar. @throws Interrupted.
void buildSceneWithBar(const std::function<void(const SceneProgress&)>& build, const Interrupt& interrupt);

/// Prints the bodies that could not be built, which no cycle checks, to stderr. @return true if there are none.
bool areAllMade(const Scene& scene);

/// The plan's table, and a line for each warning.
std::string planText(const Scene& scene, const std::vector<std::string>& warnings);

}  // namespace sdf_ccd::tools
