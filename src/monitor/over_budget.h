#pragma once

#include <string>

#include "sdf_ccd/scene.h"

namespace sdf_ccd {

/// Explains in one line why a scene's error bound exceeds the required max_error. Empty if the bound is met or none is
/// required.
std::string overBudget(const Scene& scene);

}  // namespace sdf_ccd
