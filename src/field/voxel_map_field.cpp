// The field of a whole map of voxels; see voxel_field.h.
#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>

#include "common/lattice.h"
#include "common/parallel_for.h"
#include "common/progress_counter.h"
#include "field/corner_squares.h"
#include "field/field_access.h"
#include "field/lattice_grid.h"
#include "field/uniform/uniform_shape.h"
#include "field/voxel_field.h"
#include "grid_cell.h"

namespace sdf_ccd {
namespace {

constexpr int kMaxReach = 50;  // cells; limits a block's window to the width that LatticeDistance allows
constexpr int kBlock = 4;      // bricks along the side of a block, whose bricks share one LatticeDistance

int cellsPerVoxel(const VoxelSolid& solid, double cell) {
  return static_cast<int>(std::lround(solid.size() / cell));
}

int floorDivide(int a, int b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}

/// The options with a cell of which the voxels' side is exactly a multiple: a small difference adds up along the map.
FieldOptions exactCell(const VoxelSolid& solid, FieldOptions options) {
  options.cell_size = solid.size() / cellsPerVoxel(solid, *options.cell_size);
  return options;
}

/// Makes the grid of a map, block by block of bricks.
class MapGrid {
 public:
  MapGrid(const VoxelSolid& solid, const FieldOptions& options)
      : solid_(solid),
        grid_(solid.box(), solid.origin(), exactCell(solid, options)),
        n_(cellsPerVoxel(solid, grid_.shape.cell)) {
    requireBytes(shape().coarseBytes(), shape(), options);
  }

  const GridShape& shape() const { return grid_.shape; }

  std::vector<float> corners() const {
    std::vector<float> outside = squares(true);
    if (std::find(outside.begin(), outside.end(), 0.0F) == outside.end()) return inMetres(outside, {});
    return inMetres(outside, squares(false));
  }

  Vector3i blocks() const { return (shape().bricks.array() + kBlock - 1) / kBlock; }
  Vector3i blockAt(std::size_t i) const { return pointIn(blocks(), i); }

  /// Finds the bricks of a block that need samples, and their samples. @param corners  distances at all corners.
  void make(const Vector3i& block, const std::vector<float>& corners, std::vector<std::size_t>& bricks,
            BrickSamples& samples) const {
    const Vector3i first = kBlock * block, end = (first.array() + kBlock).min(shape().bricks.array());
    std::vector<Vector3i> near;
    forEachPoint(first, end, [&](const Vector3i& b) {
      if (mayBeNear(b, corners)) near.push_back(b);
    });
    if (near.empty()) return;
    const int reach = farthestSample(shape());
    const Vector3i low = grid_.low + GridShape::kBrick * first, high = grid_.low + GridShape::kBrick * end;
    Vector3i first_voxel, last_voxel;
    for (int k = 0; k < 3; ++k) {
      first_voxel[k] = floorDivide(low[k] - reach, n_);
      last_voxel[k] = floorDivide(high[k] + reach, n_);
    }
    LatticeDistance distances;
    distances.compute(n_, low, (high - low).array() + 1, first_voxel, last_voxel,
                      [&](const Vector3i& v) { return solid_.isIn(v.x(), v.y(), v.z()); });
    for (const Vector3i& b : near)
      if (samples.append(distances, GridShape::kBrick * (b - first), shape())) bricks.push_back(shape().brickIndex(b));
  }

 private:
  /// Whether a brick may need samples, judged by the distances at its corners.
  bool mayBeNear(const Vector3i& brick, const std::vector<float>& corners) const {
    // Every point of the brick is at most half of its diagonal from one of its corners.
    return nearestCorner(shape(), corners, brick) <=
           shape().band + (1.0 + kHalfSqrt3 * (1 + GridShape::kBrick)) * shape().cell;
  }

  std::vector<float> squares(bool to_occupied) const {
    std::vector<float> found(shape().cornerCount(), std::numeric_limits<float>::infinity());
    const CornerSquares squares(solid_, grid_, n_, to_occupied);
    parallelFor(0, squares.columns(), [&](int column) { squares.compute(column, found); });
    return found;
  }

  std::vector<float> inMetres(std::vector<float> outside, const std::vector<float>& inside) const {
    for (std::size_t i = 0; i < outside.size(); ++i) {
      const double squared = outside[i] > 0.0F ? double(outside[i]) : double(inside[i]);
      outside[i] = static_cast<float>((outside[i] > 0.0F ? 1.0 : -1.0) * shape().cell * std::sqrt(squared));
    }
    return outside;
  }

  const VoxelSolid& solid_;
  const LatticeGrid grid_;
  const int n_;
};

constexpr std::size_t kBrickBytes = GridShape::kSamples * sizeof(std::int16_t);

}  // namespace

bool canBeLattice(const VoxelSolid& solid, const FieldOptions& options) {
  if (!options.cell_size || options.max_error || options.cells) return false;
  const double n = solid.size() / *options.cell_size;
  if (!(n > 0.5 && n < 16.5) || std::abs(n - std::round(n)) > 1e-6 * n) return false;
  GridShape shape;
  shape.cell = *options.cell_size;
  shape.band = std::max(options.band, 2.0 * shape.cell);
  return farthestSample(shape) <= kMaxReach;
}

DistanceField buildField(const VoxelSolid& solid, const FieldOptions& options, const Progress& progress) {
  validate(options);
  const MapGrid map(solid, options);
  const GridShape& shape = map.shape();
  GridData data;
  data.corners = map.corners();
  data.slots.assign(shape.brickCount(), SparseGrid::kFar);

  const std::size_t blocks = static_cast<std::size_t>(map.blocks().prod());
  std::vector<std::vector<std::int16_t>> made(blocks);
  std::vector<std::vector<std::size_t>> bricks(blocks);
  std::mutex mutex;
  std::size_t bytes = shape.coarseBytes();
  ProgressCounter counter(progress, blocks);
  parallelFor(std::size_t{0}, blocks, [&](std::size_t i) {
    BrickSamples samples;
    map.make(map.blockAt(i), data.corners, bricks[i], samples);
    made[i] = std::move(samples.samples);
    {
      const std::lock_guard<std::mutex> lock(mutex);
      bytes += bricks[i].size() * kBrickBytes;
      requireBytes(bytes, shape, options);
    }
    counter.add();
  });
  std::int32_t slot = 0;
  for (const std::vector<std::size_t>& of_block : bricks)
    for (const std::size_t brick : of_block) data.slots[brick] = slot++;
  data.samples.reserve(static_cast<std::size_t>(slot) * GridShape::kSamples);
  for (std::vector<std::int16_t>& of_block : made) {
    data.samples.insert(data.samples.end(), of_block.begin(), of_block.end());
    of_block = {};
  }
  return FieldAccess::make(std::make_shared<const SparseGrid>(shape, std::move(data)), nullptr, solid.moved());
}

}  // namespace sdf_ccd
