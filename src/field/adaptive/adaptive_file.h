#pragma once

#include <string>

#include "field/adaptive/adaptive_grid.h"
#include "field/opening_caps.h"
#include "sdf_ccd/field/distance_field.h"
#include "storage/checked_file.h"

namespace sdf_ccd {

/// The kind of checked file that holds an adaptive grid.
constexpr char kAdaptiveFileKind[] = "adaptive field";

/// @param openings  null where there are none.
void saveAdaptive(const AdaptiveGrid& grid, const OpeningCaps* openings, const std::string& path);

/// @throws std::runtime_error naming the path and what is wrong with the file.
DistanceField loadAdaptive(const std::string& path);

}  // namespace sdf_ccd
