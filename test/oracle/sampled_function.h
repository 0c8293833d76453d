#pragma once

#include <memory>

#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/field/distance_field.h"

namespace sdf_ccd::test {

/// A field whose samples are f at the grid points, all of them stored; f need not be a distance.
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
  for (Vector3i b(0, 0, 0); b.z() < bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < bricks.x(); ++b.x()) {
        data.slots.push_back(static_cast<std::int32_t>(data.slots.size()));
        for (int k = 0; k < GridShape::kSamples; ++k) {
          const Vector3i i(k % 9, k / 9 % 9, k / 81);
          data.samples.push_back(float(f(Vector3d(shape.origin + cell * (GridShape::kBrick * b + i).cast<double>()))));
        }
      }
  return DistanceField(std::make_shared<const SparseGrid>(shape, std::move(data)));
}

}  // namespace sdf_ccd::test
