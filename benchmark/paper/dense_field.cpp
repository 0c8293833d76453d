#include "dense_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "field/trilinear_cell.h"

namespace sdf_ccd::benchmark {
namespace {

constexpr int kBlock = 8;

/// Computes the samples of one block, at the grid's end with its last grid points.
void fillBlock(const DistanceField& source, const Vector3i& first, DenseField& field) {
  const Vector3i last = (first.array() + kBlock).min(field.cells);
  const auto place = [&](int x, int y, int z) -> Vector3d { return field.origin + field.cell * Vector3d(x, y, z); };
  const Vector3d low = place(first.x(), first.y(), first.z()), high = place(last.x(), last.y(), last.z());
  const FieldSample center = source.sample(0.5 * (low + high));
  const bool near = std::abs(center.value) - center.error < source.band() + 0.5 * (high - low).norm();
  std::array<double, 8> corners{};
  if (!near) {
    for (int k = 0; k < 8; ++k) {
      corners[k] = source.sample({(k & 1 ? high : low).x(), (k & 2 ? high : low).y(), (k & 4 ? high : low).z()}).value;
    }
  }
  // The last points belong to the next block, which computes them; at the grid's end there is no next block.
  const Vector3i end = (last.array() == field.cells).select(last.array() + 1, last);
  for (int z = first.z(); z < end.z(); ++z)
    for (int y = first.y(); y < end.y(); ++y)
      for (int x = first.x(); x < end.x(); ++x) {
        const Vector3d u = (Vector3i(x, y, z) - first).cast<double>().cwiseQuotient((last - first).cast<double>());
        field.samples[field.index(x, y, z)] =
            static_cast<float>(near ? source.sample(place(x, y, z)).value : trilinear(corners, u));
      }
}

}  // namespace

DenseField sampleDensely(const DistanceField& source, int cells) {
  const AlignedBox3d& box = source.surfaceBox();
  const double side = box.sizes().maxCoeff();
  DenseField field{box.center().array() - 0.5 * side, side / cells, cells, nullptr};
  field.samples.reset(new float[field.bytes() / sizeof(float)]);
  const int blocks = (cells + kBlock - 1) / kBlock;
  tbb::parallel_for(0, blocks * blocks, [&](int i) {
    for (int x = 0; x < blocks; ++x) fillBlock(source, kBlock * Vector3i(x, i % blocks, i / blocks), field);
  });
  return field;
}

std::size_t MinMaxOctree::bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels) sum += level.ranges.size() * sizeof(Range);
  return sum;
}

MinMaxOctree buildOctree(const DenseField& field) {
  MinMaxOctree octree;
  for (int below = field.cells; below > 1 || octree.levels.empty();) {
    const int size = (below + 1) / 2;
    MinMaxOctree::Level level{size, std::vector<MinMaxOctree::Range>(std::size_t(size) * size * size)};
    const MinMaxOctree::Level* children = octree.levels.empty() ? nullptr : &octree.levels.back();
    tbb::parallel_for(0, size, [&](int z) {
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          MinMaxOctree::Range range{INFINITY, -INFINITY};
          // Blocks of samples share their faces, blocks of nodes do not.
          const int end = children ? 1 : 2, limit = children ? below - 1 : below;
          for (int k = 2 * z; k <= std::min(2 * z + end, limit); ++k)
            for (int j = 2 * y; j <= std::min(2 * y + end, limit); ++j)
              for (int i = 2 * x; i <= std::min(2 * x + end, limit); ++i) {
                const float sample = children ? 0.0F : field.samples[field.index(i, j, k)];
                const MinMaxOctree::Range part = children ? children->ranges[(std::size_t(k) * below + j) * below + i]
                                                          : MinMaxOctree::Range{sample, sample};
                range = {std::min(range.min, part.min), std::max(range.max, part.max)};
              }
          level.ranges[(std::size_t(z) * size + y) * size + x] = range;
        }
    });
    octree.levels.push_back(std::move(level));
    below = size;
  }
  return octree;
}

}  // namespace sdf_ccd::benchmark
