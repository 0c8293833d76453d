#pragma once

#include <string>

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// What a scene's error bound is more than the max_error asked for by: the bodies that cause it, the worst first, and
/// the source of each; empty if the bound is kept, or none was asked for. One line: "the error bound is 13.11 mm, more
/// than the max_error of 5.00 mm: map is only a field, so gaps of 10.00 mm between points of faces count, not 1.75".
std::string overBudget(const Scene& scene);

}  // namespace sdf_ccd
