#include "field/uniform/sparse_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/number_text.h"
#include "common/parallel_for.h"
#include "field/cube_corner.h"
#include "field/empty_sphere_search.h"
#include "field/grid_cell.h"
#include "field/grid_limits.h"

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

/// A finite number minus itself is zero; the compiler vectorises this loop.
bool allFinite(View<float> values) {
  bool finite = true;
  for (std::size_t i = 0; i < values.size; ++i) finite &= values[i] - values[i] == 0.0F;
  return finite;
}

/// A word per brick.
std::vector<std::uint32_t> brickWords(const GridShape& shape, const GridData& data) {
  std::vector<float> corners;  // in bricks
  const double bricks_per_metre = 1.0 / (GridShape::kBrick * shape.cell);
  corners.reserve(data.corners.size());
  for (const float metres : data.corners) corners.push_back(static_cast<float>(metres * bricks_per_metre));
  const EmptySphereSearch search(EmptySphereSearch::Lattice::kCorners, shape.bricks, corners);
  std::vector<std::uint32_t> words(data.slots.size());
  parallelFor(0, shape.bricks.z(), [&](int z) {
    for (int y = 0; y < shape.bricks.y(); ++y)
      for (int x = 0; x < shape.bricks.x(); ++x) {
        const Vector3i brick(x, y, z);
        const std::size_t i = shape.brickIndex(brick);
        if (data.slots[i] != SparseGrid::kFar) {
          words[i] = brick_word::slot(data.slots[i]);
        } else {
          words[i] = search.ball(brick).word();
        }
      }
  });
  return words;
}

}  // namespace

SparseGrid::SparseGrid(const GridShape& shape, GridData data) : shape_(shape) {
  const auto owned = std::make_shared<OwnedGrid>();
  owned->data = std::move(data);
  const std::vector<std::int32_t>& slots = owned->data.slots;
  arrays_ = {viewOf(owned->data.corners), {}, viewOf(owned->data.samples)};
  if (slots.size() != shape.brickCount() || arrays_.corners.size != shape.cornerCount()) {
    throw std::invalid_argument("sparse grid: " + std::to_string(slots.size()) + " slots and " +
                                std::to_string(arrays_.corners.size) + " corners for " +
                                std::to_string(shape.brickCount()) + " bricks");
  }
  owned->words = brickWords(shape, owned->data);
  arrays_.words = viewOf(owned->words);
  owned->data.slots = {};
  owner_ = owned;
  const double largest = GridShape::kMaxSteps * shape.step;
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
  if (!(shape_.cell > 0.0) || !std::isfinite(shape_.cell)) fail("invalid cell size " + numberText(shape_.cell) + " m");
  if (!shape_.origin.allFinite()) fail("origin is not finite");
  if (!(shape_.band >= 0.0) || !std::isfinite(shape_.band)) fail("invalid band " + numberText(shape_.band) + " m");
  if (!(error_bound_ >= 0.0) || !std::isfinite(error_bound_))
    fail("invalid error bound " + numberText(error_bound_) + " m");
  if (shape_.bricks.minCoeff() < 1 || shape_.bricks.maxCoeff() > 4096)
    fail("the number of bricks per axis is not within 1 to 4096");
  if (!canResolve(shape_.box(), shape_.cell)) fail("the grid is too far from its origin to resolve its cells");
  if (!isSurfaceBox(shape_.surface_box, shape_.box()))
    fail("the surface's bounding box is not valid, or not within that of the grid");
  if (arrays_.words.size != shape_.brickCount())
    fail(std::to_string(arrays_.words.size) + " words for " + std::to_string(shape_.brickCount()) + " bricks");
  if (arrays_.corners.size != shape_.cornerCount()) {
    fail(std::to_string(arrays_.corners.size) + " corners for " + std::to_string(shape_.brickCount()) + " bricks");
  }
  const double brick = GridShape::kBrick * shape_.cell;  // the band, within the grid, needs no larger steps
  if (!(shape_.step > 0.0) || !(shape_.step <= brick)) fail("invalid step " + numberText(shape_.step) + " m");
  if (arrays_.samples.size % GridShape::kSamples != 0) fail("the samples end in the middle of a brick");
  if (!allFinite(arrays_.corners)) fail("a corner value is not finite");
  const auto stored = static_cast<std::uint32_t>(arrays_.samples.size / GridShape::kSamples);
  for (std::size_t i = 0; i < arrays_.words.size; ++i) {
    const std::uint32_t word = arrays_.words[i];
    if (!brick_word::isFar(word) && word >> 1 >= stored) fail("slot " + std::to_string(word >> 1) + " is out of range");
  }
}

std::array<double, 8> SparseGrid::brickCorners(const Vector3i& brick) const {
  return cornersOf(shape_, arrays_.corners, brick);
}

std::size_t SparseGrid::bytes() const {
  return arrays_.corners.size * sizeof(float) + arrays_.words.size * sizeof(std::uint32_t) +
         arrays_.samples.size * sizeof(std::int16_t);
}

}  // namespace sdf_ccd
