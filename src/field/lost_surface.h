#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/files/checked_file.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd {

/// What a field does not show of its mesh: walls so thin that no sample lies deep enough in them for the interpolated
/// value to be negative between their two sides. A point that crosses such a wall is never inside.
struct LostSurface {
  double share = 0.0;     ///< of the surface's area, up to 1
  double thickest = 0.0;  ///< thickness of the thickest of these walls [m]
};

/// saveField(), with what the field does not show; empty: not known.
void saveField(const DistanceField& field, const std::string& path, const std::string& key,
               const std::optional<LostSurface>& lost);

/// What a file of saveField() says about that. @throws std::runtime_error as loadField().
std::optional<LostSurface> loadLostSurface(const std::string& path);

/// Appends it as the last section of a field's file; an empty one if it is not known.
inline void addLost(const std::optional<LostSurface>& lost, std::vector<FileSection>& sections) {
  sections.push_back(lost ? FileSection{&*lost, sizeof *lost} : FileSection{nullptr, 0});
}

/// Reads the section that addLost() wrote.
inline std::optional<LostSurface> lostIn(const CheckedFile& file, std::size_t section, const std::string& path) {
  std::size_t count = 0;
  const auto* lost = file.section<LostSurface>(section, count);
  if (count == 0) return std::nullopt;
  const bool is_valid =
      count == 1 && lost->share >= 0.0 && lost->share <= 1.0 && lost->thickest >= 0.0 && std::isfinite(lost->thickest);
  if (!is_valid) throw std::runtime_error(path + ": damaged: the share of the surface that is lost is not valid");
  return *lost;
}

}  // namespace sdf_ccd
