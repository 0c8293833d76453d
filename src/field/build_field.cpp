#include "sdf_ccd/field/build_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "common/parallel_for.h"
#include "common/progress_counter.h"
#include "cube_corner.h"
#include "field/adaptive/build_adaptive.h"
#include "field/opening_caps.h"
#include "field/uniform/brick_sampler.h"
#include "field/uniform/uniform_shape.h"
#include "geometry/closed_solid.h"
#include "spread_order.h"

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
  for (Vector3i b(0, 0, 0); b.z() < shape.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape.bricks.x(); ++b.x()) {
        std::int32_t& slot = data.slots[shape.brickIndex(b)];
        if (slot == SparseGrid::kFar) continue;
        slot = static_cast<std::int32_t>(sampled.size());
        sampled.push_back(b);
        largest = std::max(largest, largestSample(shape, data.corners, b));
      }
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
    sampler.fill(sampled[i], metres.data());
    std::transform(metres.begin(), metres.end(), data.samples.begin() + std::ptrdiff_t(first),
                   [&](float metres) { return shape.inSteps(metres); });
    counter.add();
  });
  return std::make_shared<const SparseGrid>(shape, std::move(data));
}

/// The caps that a field stores: those that reach farther than `limit` [m] from the mesh. Null if none do.
/// @param narrow  is set to the largest reach of the others [m].
std::shared_ptr<const OpeningCaps> wideCaps(const Openings& openings, double limit, double& narrow) {
  TriangleMesh caps;
  std::vector<double> reach;
  narrow = 0.0;
  for (std::size_t i = 0; i < openings.reach.size(); ++i) {
    if (openings.reach[i] <= limit) {
      narrow = std::max(narrow, openings.reach[i]);
      continue;
    }
    for (int k = 0; k < 3; ++k) caps.vertices.push_back(openings.caps.vertices[openings.caps.triangles[i][k]]);
    const int last = static_cast<int>(caps.vertices.size());
    caps.triangles.emplace_back(last - 3, last - 2, last - 1);
    reach.push_back(openings.reach[i]);
  }
  if (reach.empty()) return nullptr;
  return std::make_shared<const OpeningCaps>(std::move(caps), std::move(reach));
}

}  // namespace

DistanceField buildField(const TriangleMesh& mesh, const FieldOptions& options, const Progress& progress) {
  validate(mesh);
  validate(options);
  return buildField(Solid(mesh), options, progress);
}

DistanceField buildField(const Solid& solid, const FieldOptions& options, const Progress& progress) {
  return buildField(ClosedSolid(std::shared_ptr<const Solid>(&solid, [](const Solid*) {})), options, progress);
}

DistanceField buildField(const ClosedSolid& closed, const FieldOptions& given, const Progress& progress) {
  const FieldOptions options = withResolution(given);
  double narrow = 0.0;
  if (options.max_error) {
    const double wanted = *options.max_error;
    std::shared_ptr<const OpeningCaps> caps = wideCaps(closed.openings(), kNarrowCap * wanted, narrow);
    const double moved = closed.moved() + narrow;
    FieldOptions rest = options;
    rest.max_error = std::max(wanted - moved, 0.5 * wanted);
    return DistanceField(buildAdaptive(closed.solid(), rest, progress), std::move(caps), moved);
  }
  std::shared_ptr<const SparseGrid> grid = buildUniform(closed.solid(), options, progress);
  std::shared_ptr<const OpeningCaps> caps = wideCaps(closed.openings(), kNarrowCap * grid->errorBound(), narrow);
  return DistanceField(std::move(grid), std::move(caps), closed.moved() + narrow);
}

}  // namespace sdf_ccd
