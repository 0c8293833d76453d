#pragma once

#include <optional>
#include <string>

#include "common/files/checked_file.h"
#include "field/adaptive/adaptive_grid.h"
#include "field/lost_surface.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// The kind of checked file that holds an adaptive grid.
constexpr char kAdaptiveFileKind[] = "adaptive field";

/// As saveField(). @param grid  of the field.
void saveAdaptive(const AdaptiveGrid& grid, const DistanceField& field, const std::string& path, const std::string& key,
                  const std::optional<LostSurface>& lost);

/// As loadField().
DistanceField loadAdaptive(const std::string& path, const std::string& key);

/// As loadLostSurface().
std::optional<LostSurface> loadLostOfAdaptive(const std::string& path);

}  // namespace sdf_ccd
