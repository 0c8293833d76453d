#pragma once

#include <cstddef>
#include <optional>

#include "sdf_ccd/common/progress.h"

namespace sdf_ccd {

/// How fine a field is. Exactly one of the first three is set.
struct FieldOptions {
  std::optional<int> cells;         ///< cells along the longest side of the surface's box
  std::optional<double> cell_size;  ///< [m]
  /// |interpolated − true distance| in the band [m]; cells of several sizes. Where the smallest ones do not do the
  /// field has a larger DistanceField::errorBound().
  std::optional<double> max_error;
  double band = 0.0;  ///< accurate where |φ| ≤ band [m]; at least two cells, or twice max_error, are taken
  std::size_t max_bytes = std::size_t{4} << 30;  ///< larger fields are refused, with the cell size that would fit
};

/// Throws std::invalid_argument, with the value, for options that no field can have.
void validate(const FieldOptions& options);

}  // namespace sdf_ccd
