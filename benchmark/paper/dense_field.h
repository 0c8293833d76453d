#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sdf_ccd/field.h"

namespace sdf_ccd::benchmark {

/// Signed distances at all points of a cubic grid, as in Xu & Barbič 2014, §3.1.
struct DenseField {
  Vector3d origin;                   ///< first grid point [m]
  double cell;                       ///< [m]
  int cells;                         ///< per axis; there is one grid point more
  std::unique_ptr<float[]> samples;  ///< x fastest, then y, then z [m]

  std::size_t strideY() const { return std::size_t(cells) + 1; }
  std::size_t strideZ() const { return strideY() * strideY(); }
  std::size_t index(int x, int y, int z) const { return z * strideZ() + y * strideY() + x; }
  std::size_t bytes() const { return strideZ() * strideY() * sizeof(float); }
};

/// Samples a field with `cells` cells per axis of the cube around its surface's box. Far from the surface, blocks of
/// 8³ cells are interpolated between their corners: only the sign of their values matters.
DenseField sampleDensely(const DistanceField& field, int cells);

/// Smallest and largest sample of each block of 2×2×2, 4×4×4, … cells (paper §3.2, bottom-up). Single cells have
/// no entry: their range is read from their eight samples, which saves a look-up and needs a fifth of the paper's
/// memory.
struct MinMaxOctree {
  struct Range {
    float min, max;
  };
  struct Level {
    int size;  ///< nodes per axis
    std::vector<Range> ranges;
  };
  std::vector<Level> levels;  ///< levels[k] has blocks of 2^(k+1) cells; the last one is the root

  const Range& range(std::size_t level, int x, int y, int z) const {
    const Level& l = levels[level];
    return l.ranges[(std::size_t(z >> (level + 1)) * l.size + (y >> (level + 1))) * l.size + (x >> (level + 1))];
  }
  std::size_t bytes() const;
};

MinMaxOctree buildOctree(const DenseField& field);

}  // namespace sdf_ccd::benchmark
