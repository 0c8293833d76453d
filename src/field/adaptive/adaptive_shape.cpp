#include "adaptive_shape.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/number_text.h"

namespace sdf_ccd {
namespace {

/// Top cells along the longest side. More of them shorten a query's path through far cells and save nodes; up to
/// this number the gain is larger than the cost in memory (measured on scans and links).
int topCells(double relative_error) {
  return static_cast<int>(std::clamp(std::round(2.0 / std::sqrt(relative_error)), 8.0, 64.0));
}

}  // namespace

AdaptiveShape adaptiveShape(const AlignedBox3d& surface_box, const FieldOptions& options) {
  AdaptiveShape shape;
  shape.surface_box = surface_box;
  const double longest = shape.surface_box.sizes().maxCoeff();
  shape.error_bound = *options.max_error;
  shape.cell = longest / topCells(*options.max_error / longest);
  shape.band = std::max(options.band, 2.0 * *options.max_error);
  // Padded so that no point with |φ| ≤ band is on the grid's boundary, where a query would miss the rest.
  const double padding = 1.01 * shape.band + 0.01 * shape.cell;
  const Vector3d cells = ((shape.surface_box.sizes().array() + 2.0 * padding) / shape.cell).ceil();
  if (cells.maxCoeff() > 1024.0) {
    throw std::length_error("field: a band of " + numberText(shape.band) + " m is too wide for a maximum error of " +
                            numberText(*options.max_error) + " m");
  }
  shape.size = cells.cast<int>();
  shape.origin = shape.surface_box.center() - 0.5 * shape.cell * cells;
  return shape;
}

}  // namespace sdf_ccd
