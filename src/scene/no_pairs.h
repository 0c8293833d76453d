#pragma once

#include <string>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// A warning, with the likely reason, that the scene has no pair to check; empty if it has one.
std::string whyNoPairs(const Scene& scene);

}  // namespace sdf_ccd
