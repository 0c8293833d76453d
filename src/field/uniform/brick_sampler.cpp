#include "brick_sampler.h"

#include <array>
#include <cmath>
#include <vector>

#include "common/lattice.h"
#include "field/cube_corner.h"
#include "field/near_octants.h"

namespace sdf_ccd {
namespace {

constexpr int kSide = GridShape::kSide;
constexpr int kStrides[] = {1, kSide, kSide* kSide};  ///< between the indices of neighbours along each axis

}  // namespace

BrickSampler::BrickSampler(const Solid& solid, const GridShape& shape) : shape_(shape) {
  const TriangleMesh& mesh = solid.boundary();
  // Measured on scans: for smaller cells lists are up to six times as fast as the tree; for larger ones, slower.
  if (shape.cell < 0.75 * std::sqrt(surfaceArea(mesh) / double(mesh.triangles.size()))) {
    index_.emplace(solid);
  } else {
    surface_.emplace(solid);
  }
}

void BrickSampler::fill(const Vector3i& brick, const Wanted& wanted, float* samples) const {
  if (!index_) return fillFromTree(brick, wanted, samples);
  constexpr std::size_t kMany = 300;
  const Block whole{Vector3i::Zero(), GridShape::kBrick};
  const SpaceCube cube = cubeOf(brick, whole);
  const NearCube found(*index_, cube, surface().nearest(cube.center));
  if (found.near().size() > kMany) {
    fillFromTree(brick, wanted, samples);
  } else {
    fill(brick, whole, found.near(), wanted, samples);
  }
}

void BrickSampler::fill(const Vector3i& brick, const Block& block, const NearTriangles& near, const Wanted& wanted,
                        float* samples) const {
  constexpr std::size_t kFew = 16;
  if (block.side > 1 && near.size() > kFew) {
    const int half = block.side / 2;
    NearOctants octants(near);
    for (int k = 0; k < 8; ++k) {
      fill(brick, {block.low + half * cubeCorner(k), half}, octants[k], wanted, samples);
    }
    return;
  }
  // The points of a block's upper faces belong to the next block, except at the brick's end.
  const auto end = [&](int k) { return block.low[k] + block.side + (block.low[k] + block.side == GridShape::kBrick); };
  DistanceWriter<float> writer(near, samples);
  for (int z = block.low.z(); z < end(2); ++z)
    for (int y = block.low.y(); y < end(1); ++y)
      for (int x = block.low.x(); x < end(0); ++x) {
        const int i = GridShape::sampleIndex({x, y, z});
        if (wanted[std::size_t(i)]) writer.add(i, point(brick, Vector3d(x, y, z)));
      }
}

void BrickSampler::fillFromTree(const Vector3i& brick, const Wanted& wanted, float* samples) const {
  const TriangleTree& tree = surface().tree();
  std::array<int, GridShape::kSamples> nearest;
  forEachPoint(GridShape::sides(), [&](const Vector3i& local) {
    const int i = GridShape::sampleIndex(local);
    if (!wanted[std::size_t(i)]) return;
    int likely = -1;
    for (int axis = 0; axis < 3 && likely < 0; ++axis)
      if (local[axis] > 0 && wanted[std::size_t(i - kStrides[axis])]) likely = nearest[i - kStrides[axis]];
    const Vector3d p = point(brick, local.cast<double>());
    const TriangleTree::ClosestPoint found = likely < 0 ? tree.closestPoint(p) : tree.closestPointNear(p, likely);
    nearest[i] = found.triangle;
    samples[i] = static_cast<float>(found.distance);
  });
  setSigns(brick, wanted, samples);
}

/// Neighbours whose empty spheres intersect are on the same side of a closed surface, so one winding number is enough
/// for all that are connected like this.
void BrickSampler::setSigns(const Vector3i& brick, const Wanted& wanted, float* samples) const {
  const float apart = static_cast<float>(shape_.cell * (1.0 + 1e-6));
  Wanted left = wanted;
  std::vector<Vector3i> pending;
  forEachPoint(GridShape::sides(), [&](const Vector3i& first) {
    if (!left[std::size_t(GridShape::sampleIndex(first))]) return;
    const float sign = surface().inside(point(brick, first.cast<double>())) ? -1.0F : 1.0F;
    left.reset(std::size_t(GridShape::sampleIndex(first)));
    for (pending.assign(1, first); !pending.empty();) {
      const Vector3i local = pending.back();
      pending.pop_back();
      const int i = GridShape::sampleIndex(local);
      const float distance = samples[i];
      samples[i] = sign * distance;
      if (!surface().closed()) continue;
      for (int axis = 0; axis < 3; ++axis)
        for (const int direction : {-1, 1}) {
          const int next = local[axis] + direction, k = i + direction * kStrides[axis];
          if (next < 0 || next > GridShape::kBrick || !left[std::size_t(k)] || !(distance + samples[k] > apart))
            continue;
          left.reset(std::size_t(k));
          pending.push_back(local + direction * Vector3i::Unit(axis));
        }
    }
  });
}

}  // namespace sdf_ccd
