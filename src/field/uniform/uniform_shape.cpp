#include "uniform_shape.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/infinity.h"
#include "common/number_text.h"
#include "field/cube_corner.h"

namespace sdf_ccd {
namespace {

double cellSize(const FieldOptions& options, const AlignedBox3d& surface_box) {
  if (options.cell_size) return *options.cell_size;
  return surface_box.sizes().maxCoeff() / *options.cells;
}

}  // namespace

GridShape uniformShape(const AlignedBox3d& surface_box, const FieldOptions& options) {
  GridShape shape;
  shape.surface_box = surface_box;
  shape.cell = cellSize(options, shape.surface_box);
  shape.band = std::max(options.band, 2.0 * shape.cell);
  // Padded so that no value within the band, nor its interpolation, reaches the grid's boundary.
  const double padding = shape.band + 2.0 * shape.cell;
  const Vector3d extent = shape.surface_box.sizes().array() + 2.0 * padding;
  const Vector3d bricks = (extent / (GridShape::kBrick * shape.cell)).array().ceil();
  if (bricks.maxCoeff() > 4096.0) {
    throw std::length_error(
        fmt::format("field: cells of {:g} m would be {:.15g} along the longest side; the limit is 32768", shape.cell,
                    bricks.maxCoeff() * GridShape::kBrick));
  }
  shape.bricks = bricks.cast<int>();
  shape.origin = shape.surface_box.center() - 0.5 * shape.cell * shape.cells().cast<double>();
  return shape;
}

double nearestCorner(const GridShape& shape, const std::vector<float>& corners, const Vector3i& brick) {
  double nearest = kInfinity;
  for (int k = 0; k < 8; ++k)
    nearest = std::min(nearest, std::abs(double(corners[shape.cornerIndex(brick + cubeCorner(k))])));
  return nearest;
}

void requireBytes(std::size_t bytes, const GridShape& shape, const FieldOptions& options) {
  if (bytes <= options.max_bytes) return;
  throw std::length_error("field: " + std::to_string(bytes >> 20) + " MB with cells of " + numberText(shape.cell) +
                          " m, more than the " + std::to_string(options.max_bytes >> 20) + " MB allowed; cells of " +
                          numberText(shape.cell * std::sqrt(double(bytes) / double(options.max_bytes))) +
                          " m would fit");
}

}  // namespace sdf_ccd
