#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <vector>

#include "field/field_access.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field.h"

namespace sdf_ccd::test {

/// A field whose samples are f at the grid points, all of them stored. f need not be a distance, but its values at two
/// grid points must differ by at most the points' distance (noise: by at most a cell), because queries rely on that.
/// @throws std::logic_error if two neighbours violate this.
template <class Function>
DistanceField sampledFunction(const Function& f, const Vector3i& bricks, double cell, double band) {
  GridShape shape;
  shape.bricks = bricks;
  shape.cell = cell;
  shape.band = band;
  shape.origin = -0.5 * cell * shape.cells().cast<double>();
  shape.surface_box = shape.box();
  GridData data;
  data.corners.resize(shape.cornerCount());
  for (int z = 0; z <= bricks.z(); ++z)
    for (int y = 0; y <= bricks.y(); ++y)
      for (int x = 0; x <= bricks.x(); ++x)
        data.corners[shape.cornerIndex({x, y, z})] =
            float(f(Vector3d(shape.origin + GridShape::kBrick * cell * Vector3d(x, y, z))));
  std::vector<double> values;
  for (Vector3i b(0, 0, 0); b.z() < bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < bricks.x(); ++b.x()) {
        data.slots.push_back(static_cast<std::int32_t>(data.slots.size()));
        for (int k = 0; k < GridShape::kSamples; ++k) {
          const Vector3i i(k % 9, k / 9 % 9, k / 81);
          values.push_back(f(Vector3d(shape.origin + cell * (GridShape::kBrick * b + i).cast<double>())));
          if (i.x() > 0 && std::abs(values.back() - values[values.size() - 2]) > cell * (1.0 + 1e-9)) {
            throw std::logic_error("sampled function: steeper than a distance");
          }
        }
      }
  double largest = 0.0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  shape.step = GridShape::stepFor(largest);
  for (const double value : values) data.samples.push_back(shape.inSteps(value));
  return FieldAccess::make(std::make_shared<const SparseGrid>(shape, std::move(data)));
}

}  // namespace sdf_ccd::test
