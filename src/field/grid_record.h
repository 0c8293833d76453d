#pragma once

#include <cstdint>

#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// The header of files of both kinds of grids.
struct GridRecord {
  double origin[3];
  double cell;
  double band;
  double error_bound;  ///< of the grid
  double moved;        ///< DistanceField::moved()
  double surface_min[3];
  double surface_max[3];
  std::int32_t size[3];    ///< bricks, or top cells
  std::int32_t divisions;  ///< cells (units) along the side of one of these: a file of another layout is rejected
};
static_assert(sizeof(GridRecord) == 120, "the file's layout must not depend on the compiler");

/// @param shape  of a grid of either kind.
template <class Shape>
GridRecord gridRecord(const Shape& shape, const Vector3i& size, double error_bound, int divisions, double moved) {
  GridRecord record{};
  record.cell = shape.cell;
  record.band = shape.band;
  record.error_bound = error_bound;
  record.moved = moved;
  record.divisions = divisions;
  for (int k = 0; k < 3; ++k) {
    record.origin[k] = shape.origin[k];
    record.surface_min[k] = shape.surface_box.min()[k];
    record.surface_max[k] = shape.surface_box.max()[k];
    record.size[k] = size[k];
  }
  return record;
}

template <class Shape>
void setShape(const GridRecord& record, Shape& shape, Vector3i& size) {
  shape.cell = record.cell;
  shape.band = record.band;
  shape.origin = Vector3d(record.origin);
  shape.surface_box = {Vector3d(record.surface_min), Vector3d(record.surface_max)};
  size = Vector3i(record.size);
}

}  // namespace sdf_ccd
