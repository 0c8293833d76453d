#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "common/files/view.h"
#include "field/empty_sphere.h"
#include "sdf_ccd/types.h"

namespace sdf_ccd {

/// Origin and size of a grid. Cells are cubes; 8×8×8 of them make a brick.
struct GridShape {
  static constexpr int kLogBrick = 3;
  static constexpr int kBrick = 1 << kLogBrick;  ///< cells along a brick's side
  static constexpr int kSide = kBrick + 1;       ///< samples along a brick's side
  static constexpr int kSamples = kSide * kSide * kSide;

  Vector3d origin = Vector3d::Zero();  ///< first corner of the first cell [m], frame F
  double cell = 0.0;                   ///< [m]
  Vector3i bricks = Vector3i::Zero();  ///< per axis
  double band = 0.0;                   ///< [m]
  AlignedBox3d surface_box;            ///< of the mesh [m]
  double step = 0.0;                   ///< quantisation step of the samples, which are integers of 16 bits [m]

  static constexpr double kMaxSteps = 32767.0;  ///< largest magnitude of a sample
  /// The step for samples whose magnitude is at most `largest` [m].
  static double stepFor(double largest) { return largest / kMaxSteps; }
  std::int16_t inSteps(double metres) const { return static_cast<std::int16_t>(std::lround(metres / step)); }

  Vector3i cells() const { return kBrick * bricks; }
  /// The brick that holds a cell, and the cell's place in it. Cells are not negative.
  static Vector3i brickOf(const Vector3i& cell) {
    return {cell.x() >> kLogBrick, cell.y() >> kLogBrick, cell.z() >> kLogBrick};
  }
  static Vector3i inBrick(const Vector3i& cell) {
    return {cell.x() & (kBrick - 1), cell.y() & (kBrick - 1), cell.z() & (kBrick - 1)};
  }
  std::size_t brickCount() const { return std::size_t(bricks.x()) * bricks.y() * bricks.z(); }
  std::size_t cornerCount() const { return std::size_t(bricks.x() + 1) * (bricks.y() + 1) * (bricks.z() + 1); }
  /// The memory of a grid without its samples.
  std::size_t coarseBytes() const { return cornerCount() * sizeof(float) + brickCount() * sizeof(std::int32_t); }
  std::size_t brickIndex(const Vector3i& b) const {
    return (std::size_t(b.z()) * bricks.y() + b.y()) * bricks.x() + b.x();
  }
  /// The number of a brick's samples along each axis.
  static Vector3i sides() { return Vector3i::Constant(kSide); }
  /// Index of a sample in its brick, by its position from 0 to kBrick per axis.
  static int sampleIndex(const Vector3i& local) { return (local.z() * kSide + local.y()) * kSide + local.x(); }
  /// Its index among all samples.
  static std::size_t sampleIndex(std::int32_t slot, const Vector3i& local) {
    return std::size_t(slot) * kSamples + std::size_t(sampleIndex(local));
  }
  std::size_t cornerIndex(const Vector3i& b) const {
    return (std::size_t(b.z()) * (bricks.y() + 1) + b.y()) * (bricks.x() + 1) + b.x();
  }
  AlignedBox3d box() const { return {origin, origin + cell * cells().cast<double>()}; }
};

/// The values of a grid: those of a 1-Lipschitz function, so that they bound the distance to the surface.
struct GridData {
  std::vector<float> corners;         ///< distance at every brick's corners, x fastest [m]
  std::vector<std::int32_t> slots;    ///< per brick: index of its block of samples, or kFar
  std::vector<std::int16_t> samples;  ///< kSamples per slot, x fastest [GridShape::step]
};

/// The word of a brick: if the lowest bit is set, the others are a slot; else an EmptySphere about a brick's corner.
namespace brick_word {
inline std::uint32_t slot(std::int32_t slot) {
  return static_cast<std::uint32_t>(slot) << 1 | 1U;
}
inline bool isFar(std::uint32_t word) {
  return (word & 1U) == 0;
}
}  // namespace brick_word

/// Samples of a signed distance, dense in bricks near the surface, one per brick corner elsewhere.
///
/// Memory order: x fastest, then y, then z. A brick has samples unless |φ| > band + cell in all of it. Such a far
/// brick has an EmptySphere instead, which a query skips (design §3.3): the skips are longer than with the paper's
/// min/max octree (§3.2), and need none of its memory.
class SparseGrid {
 public:
  static constexpr std::int32_t kFar = -1;

  /// @throws std::invalid_argument if the shape is not valid or the arrays' sizes do not match it.
  SparseGrid(const GridShape& shape, GridData data);

  struct Arrays {
    View<float> corners;         ///< as GridData
    View<std::uint32_t> words;   ///< per brick
    View<std::int16_t> samples;  ///< as GridData
  };

  /// A grid on memory that `owner` keeps alive (that of a file).
  SparseGrid(const GridShape& shape, const Arrays& arrays, double error_bound, std::shared_ptr<const void> owner);

  const GridShape& shape() const { return shape_; }
  View<float> corners() const { return arrays_.corners; }
  View<std::uint32_t> words() const { return arrays_.words; }
  View<std::int16_t> samples() const { return arrays_.samples; }

  /// Upper bound of the rounding of a sample to steps, and so of all interpolated values [m].
  double rounding() const { return 0.5 * shape_.step; }

  /// Bound on |interpolated − true distance| in a brick with samples [m]: for exact samples of a 1-Lipschitz function
  /// Jensen's inequality on trilinear weights gives √(Σ u(1−u)) h ≤ √3/2 h (design §3.3), plus rounding().
  double errorBound() const { return error_bound_; }

  std::size_t bytes() const;
  std::size_t storedCells() const { return arrays_.samples.size / GridShape::kSamples * 512; }

  /// Corner values of a cell in a brick with samples: bit 0 of the index is x, bit 1 y, bit 2 z.
  std::array<double, 8> cellCorners(std::int32_t slot, const Vector3i& cell_in_brick) const {
    const std::array<std::int16_t, 8> s = cellSamples(slot, cell_in_brick);
    const double step = shape_.step;
    return {step * s[0], step * s[1], step * s[2], step * s[3], step * s[4], step * s[5], step * s[6], step * s[7]};
  }

  /// The same in steps.
  std::array<std::int16_t, 8> cellSamples(std::int32_t slot, const Vector3i& cell_in_brick) const {
    constexpr int kY = GridShape::kSide, kZ = GridShape::kSide * GridShape::kSide;
    const std::int16_t* s = arrays_.samples.data + GridShape::sampleIndex(slot, cell_in_brick);
    return {s[0], s[1], s[kY], s[kY + 1], s[kZ], s[kZ + 1], s[kZ + kY], s[kZ + kY + 1]};
  }

  /// A sample of a brick [m], `local` from 0 to kBrick per axis.
  double sample(std::int32_t slot, const Vector3i& local) const {
    return shape_.step * arrays_.samples[GridShape::sampleIndex(slot, local)];
  }

  /// Distances at a brick's corners, ordered like cellCorners().
  std::array<double, 8> brickCorners(const Vector3i& brick) const;

  /// Length of a step of EmptySphere::steps [m].
  double ballStep() const { return GridShape::kBrick * shape_.cell * EmptySphere::step(shape_.bricks); }

  std::uint32_t word(const Vector3i& brick) const { return arrays_.words[shape_.brickIndex(brick)]; }

  /// The slot of a brick's samples, or kFar.
  std::int32_t slot(const Vector3i& brick) const {
    const std::uint32_t w = word(brick);
    return brick_word::isFar(w) ? kFar : static_cast<std::int32_t>(w >> 1);
  }

 private:
  void check() const;

  GridShape shape_;
  Arrays arrays_;
  std::shared_ptr<const void> owner_;
  double error_bound_ = 0.0;
};

}  // namespace sdf_ccd
