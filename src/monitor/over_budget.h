#pragma once

#include <string>

#include "sdf_ccd/monitor/scene.h"

namespace sdf_ccd {

/// Explains why a scene's error bound exceeds the required max_error: the bodies that cause it, the worst first, each
/// with the source of the error. Empty if the bound is met or none is required. One line: "the error bound is 13.11 mm,
/// more than the max_error of 5.00 mm: map is used only as a field, so the gap of 10.00 mm between face points
/// applies instead of 1.75 mm".
std::string overBudget(const Scene& scene);

}  // namespace sdf_ccd
