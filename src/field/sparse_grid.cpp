#include "sdf_ccd/field/sparse_grid.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace sdf_ccd {
namespace {

constexpr double kHalfSqrt3 = 0.8660254037844386;

}  // namespace

SparseGrid::SparseGrid(const GridShape& shape, GridData data) : shape_(shape) {
  const auto owner = std::make_shared<const GridData>(std::move(data));
  corners_ = viewOf(owner->corners);
  slots_ = viewOf(owner->slots);
  samples_ = viewOf(owner->samples);
  owner_ = owner;
  checkSizes();
  buildLevels();
}

SparseGrid::SparseGrid(const GridShape& shape, View<float> corners, View<std::int32_t> slots, View<float> samples,
                       std::shared_ptr<const void> owner)
    : shape_(shape), corners_(corners), slots_(slots), samples_(samples), owner_(std::move(owner)) {
  checkSizes();
  buildLevels();
}

void SparseGrid::checkSizes() const {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("sparse grid: " + what); };
  if (!(shape_.cell > 0.0) || !std::isfinite(shape_.cell)) fail("cell size " + std::to_string(shape_.cell));
  if (!shape_.origin.allFinite()) fail("origin is not finite");
  if (!(shape_.band >= 0.0) || !std::isfinite(shape_.band)) fail("band " + std::to_string(shape_.band));
  if (shape_.bricks.minCoeff() < 1 || shape_.bricks.maxCoeff() > 4096) fail("brick counts out of 1 to 4096");
  if (slots_.size != shape_.brickCount()) fail(std::to_string(slots_.size) + " slots do not fit the bricks");
  if (corners_.size != shape_.cornerCount()) fail(std::to_string(corners_.size) + " corners do not fit the bricks");
  if (samples_.size % GridShape::kSamples != 0) fail("samples end within a brick");
  const auto stored = static_cast<std::int64_t>(samples_.size / GridShape::kSamples);
  for (std::size_t i = 0; i < slots_.size; ++i)
    if (slots_[i] != kFar && (slots_[i] < 0 || slots_[i] >= stored)) fail("slot " + std::to_string(slots_[i]));
}

std::array<double, 8> SparseGrid::brickCorners(const Vector3i& brick) const {
  std::array<double, 8> c;
  for (int k = 0; k < 8; ++k) {
    c[k] = corners_[shape_.cornerIndex(brick + Vector3i(k & 1, (k >> 1) & 1, k >> 2))];
  }
  return c;
}

DistanceRange SparseGrid::brickRange(const Vector3i& brick) const {
  const std::int32_t slot = this->slot(brick);
  if (slot != kFar) {
    const float* s = samples_.data + std::size_t(slot) * GridShape::kSamples;
    const auto [low, high] = std::minmax_element(s, s + GridShape::kSamples);
    return {*low, *high};
  }
  // No samples: |φ| > band + cell all over the brick, with the sign of its corners, and within the Lipschitz bound of
  // them; the half cell less leaves room for rounding.
  const std::array<double, 8> c = brickCorners(brick);
  const auto [low, high] = std::minmax_element(c.begin(), c.end());
  const double outside_band = shape_.band + 0.5 * shape_.cell;
  const double slack = kHalfSqrt3 * GridShape::kBrick * shape_.cell;
  if (*low > 0.0) return {float(std::max(*low - slack, outside_band)), float(*high + slack)};
  return {float(*low - slack), float(std::min(*high + slack, -outside_band))};
}

void SparseGrid::buildLevels() {
  float largest = 0.0F;
  for (std::size_t i = 0; i < samples_.size; ++i) largest = std::max(largest, std::abs(samples_[i]));
  error_bound_ = kHalfSqrt3 * shape_.cell + 2.0 * largest * std::numeric_limits<float>::epsilon();

  levels_.push_back({shape_.bricks, {}});
  levels_[0].ranges.resize(shape_.brickCount());
  for (Vector3i b(0, 0, 0); b.z() < shape_.bricks.z(); ++b.z())
    for (b.y() = 0; b.y() < shape_.bricks.y(); ++b.y())
      for (b.x() = 0; b.x() < shape_.bricks.x(); ++b.x()) levels_[0].ranges[shape_.brickIndex(b)] = brickRange(b);

  while (levels_.back().size.maxCoeff() > 1) {
    const Level& fine = levels_.back();
    Level coarse{(fine.size.array() + 1) / 2, {}};
    constexpr float kInfinity = std::numeric_limits<float>::infinity();
    coarse.ranges.assign(std::size_t(coarse.size.prod()), {kInfinity, -kInfinity});
    std::size_t i = 0;
    for (int z = 0; z < fine.size.z(); ++z)
      for (int y = 0; y < fine.size.y(); ++y)
        for (int x = 0; x < fine.size.x(); ++x, ++i) {
          auto& range =
              coarse.ranges[(std::size_t(z / 2) * coarse.size.y() + std::size_t(y / 2)) * coarse.size.x() + x / 2];
          range.min = std::min(range.min, fine.ranges[i].min);
          range.max = std::max(range.max, fine.ranges[i].max);
        }
    levels_.push_back(std::move(coarse));
  }
}

std::size_t SparseGrid::bytes() const {
  std::size_t sum = corners_.size * sizeof(float) + slots_.size * sizeof(std::int32_t) + samples_.size * sizeof(float);
  for (const Level& level : levels_) sum += level.ranges.size() * sizeof(DistanceRange);
  return sum;
}

Vector3d trilinearGradient(const std::array<double, 8>& c, const Vector3d& u) {
  const double x = u.x(), y = u.y(), z = u.z();
  const auto mix = [](double a, double b, double s) { return a + s * (b - a); };
  return {mix(mix(c[1] - c[0], c[3] - c[2], y), mix(c[5] - c[4], c[7] - c[6], y), z),
          mix(mix(c[2] - c[0], c[3] - c[1], x), mix(c[6] - c[4], c[7] - c[5], x), z),
          mix(mix(c[4] - c[0], c[5] - c[1], x), mix(c[6] - c[2], c[7] - c[3], x), y)};
}

}  // namespace sdf_ccd
