#include "build_uniform.h"

#include <algorithm>
#include <array>
#include <utility>

#include "brick_sampler.h"
#include "common/lattice.h"
#include "common/parallel_for.h"
#include "common/progress_counter.h"
#include "field/cube_corner.h"
#include "field/grid_cell.h"
#include "field/spread_order.h"
#include "shared_samples.h"
#include "uniform_shape.h"

namespace sdf_ccd {
namespace {

/// Whether a brick needs samples: its corners differ in sign, or the distance at its centre does not exclude that
/// |φ| ≤ band + cell (the band and its interpolation error) somewhere inside.
bool needsSamples(const BrickSampler& sampler, const GridShape& shape, const std::vector<float>& corners,
                  const Vector3i& brick) {
  const double side = GridShape::kBrick * shape.cell;
  int negative = 0;
  for (int k = 0; k < 8; ++k) negative += corners[shape.cornerIndex(brick + cubeCorner(k))] < 0.0F;
  if (negative % 8 != 0) return true;
  const double needed = shape.band + shape.cell;
  if (nearestCorner(shape, corners, brick) > needed + 2.0 * kHalfSqrt3 * side) return false;
  const Vector3d center = shape.origin + side * (brick.cast<double>().array() + 0.5).matrix();
  const double reach = needed + kHalfSqrt3 * side;
  return sampler.surface().tree().closestPoint(center, reach).distance < reach;
}

/// Upper bound of a brick's samples: distances at two points differ by no more than the points' distance.
double largestSample(const GridShape& shape, const std::vector<float>& corners, const Vector3i& brick) {
  return nearestCorner(shape, corners, brick) + 2.0 * kHalfSqrt3 * GridShape::kBrick * shape.cell;
}

}  // namespace

std::shared_ptr<const SparseGrid> buildUniform(const Solid& solid, const FieldOptions& options,
                                               const Progress& progress) {
  GridShape shape = uniformShape(boundingBox(solid.boundary()), options);
  const std::size_t bricks = shape.brickCount();
  requireBytes(shape.coarseBytes(), shape, options);

  const BrickSampler sampler(solid, shape);
  GridData data;
  data.corners.resize(shape.cornerCount());
  const Vector3i corner_counts = shape.bricks.array() + 1;
  parallelFor(0, corner_counts.z(), [&](int z) {
    const double side = GridShape::kBrick * shape.cell;
    SignedSurface::Nearest last{};
    for (int y = 0; y < corner_counts.y(); ++y)
      for (int x = 0; x < corner_counts.x(); ++x) {
        const Vector3d p = shape.origin + side * Vector3d(x, y, z);
        last = x == 0 ? sampler.surface().nearest(p) : sampler.surface().next(p, last, side);
        data.corners[shape.cornerIndex({x, y, z})] = static_cast<float>(last.distance);
      }
  });

  data.slots.assign(bricks, SparseGrid::kFar);
  parallelFor(0, shape.bricks.z(), [&](int z) {
    for (int y = 0; y < shape.bricks.y(); ++y)
      for (int x = 0; x < shape.bricks.x(); ++x) {
        const Vector3i b(x, y, z);
        if (needsSamples(sampler, shape, data.corners, b)) data.slots[shape.brickIndex(b)] = 0;
      }
  });
  std::vector<Vector3i> sampled;
  double largest = 0.0;
  forEachPoint(shape.bricks, [&](const Vector3i& b) {
    std::int32_t& slot = data.slots[shape.brickIndex(b)];
    if (slot == SparseGrid::kFar) return;
    slot = static_cast<std::int32_t>(sampled.size());
    sampled.push_back(b);
    largest = std::max(largest, largestSample(shape, data.corners, b));
  });
  const std::size_t samples = sampled.size() * GridShape::kSamples;
  const std::size_t bytes = shape.coarseBytes() + samples * sizeof(std::int16_t);
  requireBytes(bytes, shape, options);

  shape.step = GridShape::stepFor(largest);
  data.samples.resize(samples);
  ProgressCounter counter(progress, sampled.size());
  const SpreadOrder order(sampled.size());  // so that the part done is a fair sample, as in build_adaptive.cpp
  parallelFor(std::size_t{0}, sampled.size(), [&](std::size_t k) {
    const std::size_t i = order[k], first = i * GridShape::kSamples;
    std::array<float, GridShape::kSamples> metres;
    const BrickSampler::Wanted own = SharedSamples(shape, data.slots, sampled[i]).own();
    sampler.fill(sampled[i], own, metres.data());
    for (std::size_t s = 0; s < own.size(); ++s)
      if (own[s]) data.samples[first + s] = shape.inSteps(metres[s]);
    counter.add();
  });
  for (const Vector3i& b : sampled) SharedSamples(shape, data.slots, b).copy(data.samples);
  return std::make_shared<const SparseGrid>(shape, std::move(data));
}

}  // namespace sdf_ccd
