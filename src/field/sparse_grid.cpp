#include "sdf_ccd/field/sparse_grid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

#include "cube_corner.h"

namespace sdf_ccd {
namespace {

struct OwnedGrid {
  GridData data;
  std::vector<std::uint32_t> words;
};

std::array<double, 8> cornersOf(const GridShape& shape, View<float> corners, const Vector3i& brick) {
  std::array<double, 8> c;
  for (int k = 0; k < 8; ++k) c[k] = corners[shape.cornerIndex(brick + cubeCorner(k))];
  return c;
}

/// The distance at a far brick's centre, towards zero: it exceeds band + cell there as all over the brick, and is
/// within half a diagonal of the corners'.
double centerDistance(const GridShape& shape, View<float> corners, const Vector3i& brick) {
  const std::array<double, 8> c = cornersOf(shape, corners, brick);
  if (!shape.exact) return std::copysign(std::numeric_limits<float>::min(), c[0]);
  double farthest = 0.0;
  for (const double value : c) farthest = std::max(farthest, std::abs(value) * (1.0 - 1e-6));
  const double by_corner = farthest - kHalfSqrt3 * GridShape::kBrick * shape.cell;
  return std::copysign(std::max(by_corner, shape.band + 0.5 * shape.cell), c[0]);
}

}  // namespace

std::uint32_t brick_word::far(double distance) {
  auto rounded = static_cast<float>(distance);
  if (std::abs(double(rounded)) > std::abs(distance)) rounded = std::nextafterf(rounded, 0.0F);
  std::uint32_t bits;
  std::memcpy(&bits, &rounded, sizeof bits);
  return bits & ~1U;
}

float brick_word::distance(std::uint32_t word) {
  float value;
  std::memcpy(&value, &word, sizeof value);
  return value;
}

SparseGrid::SparseGrid(const GridShape& shape, GridData data) : shape_(shape) {
  const auto owned = std::make_shared<OwnedGrid>();
  owned->data = std::move(data);
  const std::vector<std::int32_t>& slots = owned->data.slots;
  arrays_ = {viewOf(owned->data.corners), {}, viewOf(owned->data.samples), viewOf(owned->data.steps)};
  if (slots.size() != shape.brickCount() || arrays_.corners.size != shape.cornerCount()) {
    throw std::invalid_argument("sparse grid: " + std::to_string(slots.size()) + " slots and " +
                                std::to_string(arrays_.corners.size) + " corners do not fit the bricks");
  }
  owned->words.reserve(slots.size());
  for (Vector3i b(0, 0, 0); b.z() < shape.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape.bricks.x(); ++b.x()) {
        const std::int32_t slot = slots[owned->words.size()];
        owned->words.push_back(slot == kFar ? brick_word::far(centerDistance(shape, arrays_.corners, b))
                                            : brick_word::slot(slot));
      }
  arrays_.words = viewOf(owned->words);
  owned->data.slots = {};
  owner_ = owned;
  double largest = GridShape::kMostSteps * shape.step;
  for (std::size_t i = 0; i < arrays_.samples.size; ++i) {
    largest = std::max(largest, std::abs(double(arrays_.samples[i])));
  }
  error_bound_ = kHalfSqrt3 * shape_.cell + rounding() + 2.0 * largest * std::numeric_limits<float>::epsilon();
  check();
}

SparseGrid::SparseGrid(const GridShape& shape, const Arrays& arrays, double error_bound,
                       std::shared_ptr<const void> owner)
    : shape_(shape), arrays_(arrays), owner_(std::move(owner)), error_bound_(error_bound) {
  check();
}

void SparseGrid::check() const {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("sparse grid: " + what); };
  if (!(shape_.cell > 0.0) || !std::isfinite(shape_.cell)) fail("cell size " + std::to_string(shape_.cell));
  if (!shape_.origin.allFinite()) fail("origin is not finite");
  if (!(shape_.band >= 0.0) || !std::isfinite(shape_.band)) fail("band " + std::to_string(shape_.band));
  if (!(error_bound_ >= 0.0) || !std::isfinite(error_bound_)) fail("error bound " + std::to_string(error_bound_));
  if (shape_.bricks.minCoeff() < 1 || shape_.bricks.maxCoeff() > 4096) fail("brick counts out of 1 to 4096");
  if (arrays_.words.size != shape_.brickCount())
    fail(std::to_string(arrays_.words.size) + " words do not fit the bricks");
  if (arrays_.corners.size != shape_.cornerCount()) {
    fail(std::to_string(arrays_.corners.size) + " corners do not fit the bricks");
  }
  if (!(shape_.step >= 0.0) || !std::isfinite(shape_.step)) fail("step " + std::to_string(shape_.step));
  if ((shape_.step > 0.0 ? arrays_.samples.size : arrays_.steps.size) != 0) fail("samples of the other kind");
  if (sampleCount() % GridShape::kSamples != 0) fail("samples end within a brick");
  const auto stored = static_cast<std::uint32_t>(sampleCount() / GridShape::kSamples);
  for (std::size_t i = 0; i < arrays_.words.size; ++i) {
    const std::uint32_t word = arrays_.words[i];
    if (!brick_word::isFar(word) && word >> 1 >= stored) fail("slot " + std::to_string(word >> 1));
    if (brick_word::isFar(word) && !std::isfinite(brick_word::distance(word))) fail("a distance is not finite");
  }
}

std::array<double, 8> SparseGrid::brickCorners(const Vector3i& brick) const {
  return cornersOf(shape_, arrays_.corners, brick);
}

std::size_t SparseGrid::bytes() const {
  return arrays_.corners.size * sizeof(float) + arrays_.words.size * sizeof(std::uint32_t) +
         arrays_.samples.size * sizeof(float) + arrays_.steps.size * sizeof(std::int16_t);
}

Vector3d trilinearGradient(const std::array<double, 8>& c, const Vector3d& u) {
  const double x = u.x(), y = u.y(), z = u.z();
  const auto mix = [](double a, double b, double s) { return a + s * (b - a); };
  return {mix(mix(c[1] - c[0], c[3] - c[2], y), mix(c[5] - c[4], c[7] - c[6], y), z),
          mix(mix(c[2] - c[0], c[3] - c[1], x), mix(c[6] - c[4], c[7] - c[5], x), z),
          mix(mix(c[4] - c[0], c[5] - c[1], x), mix(c[6] - c[2], c[7] - c[3], x), y)};
}

}  // namespace sdf_ccd
