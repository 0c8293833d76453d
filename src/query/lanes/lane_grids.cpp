#include <cmath>
#include <limits>

#include "segment_lanes.h"

namespace sdf_ccd {
namespace {

void setBox(LaneBox& box, const Vector3d& origin, double unit, const Vector3i& size, const std::uint32_t* top) {
  for (int k = 0; k < 3; ++k) {
    box.origin[k] = origin[k];
    box.top_size[k] = size[k];
  }
  box.top = top;
  box.units_per_metre = 1.0 / unit;
  box.ball_step = static_cast<float>(EmptySphere::step(size) * LaneBox::kUnits);
}

}  // namespace

AdaptiveLanes::AdaptiveLanes(const AdaptiveGrid& grid, double sigma_metres) {
  static_assert(LaneBox::kUnits == AdaptiveShape::kUnits, "the same units");
  const AdaptiveGrid::Arrays& arrays = grid.arrays();
  const AdaptiveShape& shape = grid.shape();
  setBox(*this, shape.origin, shape.unit(), shape.size, arrays.top.data);
  ball_offset = 0.5F * kUnits;
  nodes = arrays.nodes.data;
  bases = arrays.bases.data;
  leaves = arrays.leaves.data;
  splits = arrays.splits.data;
  const double to_units = units_per_metre;
  sigma = static_cast<float>(sigma_metres * to_units);
  margin = static_cast<float>((std::abs(sigma_metres) + shape.error_bound) * to_units);
  // The error of the leaf's value, that of the leaves beyond, and the rounding of single precision.
  leaf_margin = static_cast<float>(2.0 * shape.error_bound * to_units + 0.02);
  // All these steps are linear in the side.
  const double none = AdaptiveGrid::farStepFor(0.0, shape.band),
               unit = AdaptiveGrid::farStepFor(shape.unit(), shape.band);
  far_step = static_cast<float>(none * to_units);
  far_step_per_side = static_cast<float>((unit - none) * to_units);
  const LeafScale &one = grid.scale(1), &two = grid.scale(2);
  offset_per_side = static_cast<float>((two.offset - one.offset) * to_units);
  corner_per_side = static_cast<float>((two.corner - one.corner) * to_units);
  offset = static_cast<float>((2.0 * one.offset - two.offset) * to_units);
  corner = static_cast<float>((2.0 * one.corner - two.corner) * to_units);
}

UniformLanes::UniformLanes(const SparseGrid& grid, double sigma_metres) {
  const GridShape& shape = grid.shape();
  setBox(*this, shape.origin, GridShape::kBrick * shape.cell / kUnits, shape.bricks, grid.words().data);
  ball_offset = 0.0F;
  samples = grid.samples().data;
  sigma = static_cast<float>(sigma_metres / shape.step);
  per_sample = static_cast<float>(shape.step * units_per_metre);
  rounding = static_cast<float>(2.0 * grid.rounding() * units_per_metre);
  margin = static_cast<float>((std::abs(sigma_metres) + grid.errorBound()) * units_per_metre);
  leaf_margin = std::numeric_limits<float>::max();  // the balls about the next cell's samples extend farther
}

}  // namespace sdf_ccd
