#pragma once

#include <memory>
#include <string>

#include "sdf_ccd/field/adaptive_grid.h"
#include "sdf_ccd/field/checked_file.h"

namespace sdf_ccd {

/// The kind of checked file that holds an adaptive grid.
constexpr char kAdaptiveFileKind[] = "adaptive field";

void saveAdaptive(const AdaptiveGrid& grid, const std::string& path);

/// @throws std::runtime_error naming the path and what is wrong with the file.
std::shared_ptr<const AdaptiveGrid> loadAdaptive(const std::string& path);

}  // namespace sdf_ccd
