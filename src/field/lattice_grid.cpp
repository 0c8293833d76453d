#include "field/lattice_grid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/infinity.h"
#include "field/uniform/uniform_shape.h"
#include "grid_cell.h"

namespace sdf_ccd {

LatticeGrid::LatticeGrid(const AlignedBox3d& box, const Vector3d& origin, const FieldOptions& options) {
  const double band = std::max(options.band, 2.0 * *options.cell_size);
  FieldOptions wider = options;
  wider.band = band + *options.cell_size;  // room for the shift of the grid
  shape = uniformShape(box, wider);
  shape.band = band;
  // The origin moves down to the lattice, on which the box's corners lie, by less than a cell (1e-6: rounding).
  low = ((shape.origin - origin) / shape.cell)
            .array()
            .unaryExpr([](double c) { return std::floor(c + 1e-6); })
            .cast<int>();
  shape.origin = origin + shape.cell * low.cast<double>();
  shape.step = GridShape::stepFor(farthestSample(shape) * shape.cell);
}

int farthestSample(const GridShape& shape) {
  // The smallest |φ| of a brick's samples is at most the band, one cell and half of a cell's diagonal, see append().
  // The other samples are no farther from that one than the brick's diagonal.
  constexpr double kMore = 1.0 + kHalfSqrt3 + 2.0 * kHalfSqrt3 * GridShape::kBrick;
  return static_cast<int>(std::ceil(shape.band / shape.cell + kMore)) + 1;
}

bool BrickSamples::append(const LatticeDistance& distances, const Vector3i& first, const GridShape& shape) {
  std::array<float, GridShape::kSamples> metres;
  double nearest = kInfinity;
  std::size_t at = 0;
  for (int z = 0; z < GridShape::kSide; ++z)
    for (int y = 0; y < GridShape::kSide; ++y)
      for (int x = 0; x < GridShape::kSide; ++x) {
        const double distance = shape.cell * distances.at(first + Vector3i(x, y, z));
        metres[at++] = static_cast<float>(distance);
        nearest = std::min(nearest, std::abs(distance));
      }
  // Samples are a cell apart: between them |φ| can be smaller by at most half of the cell's diagonal.
  if (nearest - kHalfSqrt3 * shape.cell > shape.band + shape.cell) return false;
  ++bricks;
  for (const float distance : metres) samples.push_back(shape.inSteps(distance));
  return true;
}

}  // namespace sdf_ccd
