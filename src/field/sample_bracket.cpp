#include "sample_bracket.h"

#include <cmath>
#include <limits>
#include <optional>

namespace sdf_ccd {
namespace {

constexpr int kLayers = 12;  ///< of samples, to either side; beyond, the surface has turned away

/// The sample at a corner of a cell [m], if its brick has samples.
std::optional<double> sampleAt(const SparseGrid& grid, const Vector3i& corner) {
  const Vector3i cells = grid.shape().cells();
  if ((corner.array() < 0).any() || (corner.array() > cells.array()).any()) return std::nullopt;
  const Vector3i brick = corner.cwiseMin((cells.array() - 1).matrix()) / GridShape::kBrick;
  const std::int32_t slot = grid.slot(brick);
  if (slot == SparseGrid::kFar) return std::nullopt;
  return grid.sample(slot, corner - GridShape::kBrick * brick);
}

}  // namespace

DistanceBounds sampleBracket(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const GridShape& shape = grid.shape();
  const Vector3d g = (p_F - shape.origin) / shape.cell;
  Vector3d::Index axis = 0;
  const double steepest = gradient.cwiseAbs().maxCoeff(&axis);
  DistanceBounds bounds{-kInfinity, kInfinity};
  if (!(steepest > 0.0)) return bounds;
  for (const int uphill : {-1, 1}) {
    const Vector3d step = uphill / steepest * gradient;  // to the next layer
    const bool to_higher = step[axis] > 0.0;
    const double first = to_higher ? std::ceil(g[axis]) - g[axis] : g[axis] - std::floor(g[axis]);
    for (int layer = 0; layer < kLayers; ++layer) {
      const Vector3d at = g + (first + layer) * step;
      const Vector3d corner = at.array().round();
      const std::optional<double> sample = sampleAt(grid, corner.cast<int>());
      if (!sample) break;
      const double rounding = grid.rounding() + std::numeric_limits<float>::epsilon() * std::abs(*sample);
      const double reach = (corner - g).norm() * shape.cell + rounding;
      if (uphill > 0) {
        bounds.low = std::max(bounds.low, *sample - reach);
      } else {
        bounds.high = std::min(bounds.high, *sample + reach);
      }
    }
  }
  return bounds;
}

}  // namespace sdf_ccd
