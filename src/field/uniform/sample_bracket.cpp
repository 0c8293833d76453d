#include "sample_bracket.h"

#include <cmath>
#include <limits>
#include <optional>

#include "common/infinity.h"
#include "field/uniform/sparse_grid.h"

namespace sdf_ccd {
namespace {

constexpr int kLayers = 12;  ///< of samples, on either side; farther away the surface's normal has changed

/// Reads samples one by one; those of the same brick in a row cost least.
class SampleReader {
 public:
  explicit SampleReader(const SparseGrid& grid) : grid_(grid), cells_(grid.shape().cells()) {}

  /// The sample at a corner of a cell [m], if its brick has samples.
  std::optional<double> at(const Vector3i& corner) {
    if ((corner.array() < 0).any() || (corner.array() > cells_.array()).any()) return std::nullopt;
    const Vector3i brick = GridShape::brickOf(corner.cwiseMin((cells_.array() - 1).matrix()));
    if (brick != brick_) {
      brick_ = brick;
      slot_ = grid_.slot(brick);
    }
    if (slot_ == SparseGrid::kFar) return std::nullopt;
    return grid_.sample(slot_, corner - GridShape::kBrick * brick);
  }

 private:
  const SparseGrid& grid_;
  Vector3i cells_;
  Vector3i brick_ = Vector3i::Constant(-1);  // of slot_
  std::int32_t slot_ = SparseGrid::kFar;
};

/// A sample and an upper bound of its error [m].
struct Sample {
  Vector3d corner;  ///< in cells
  double value, rounding;
};

/// Visits the samples nearest to the line through `g` [cells], one per layer, from `g` on along the gradient or against
/// it.
template <class Visit>
void visitSamples(const SparseGrid& grid, const Vector3d& g, const Vector3d& gradient, const Visit& visit) {
  Vector3d::Index axis = 0;
  const double steepest = gradient.cwiseAbs().maxCoeff(&axis);
  if (!(steepest > 0.0)) return;
  const Vector3d step = gradient / steepest;  // to the next layer
  const bool to_higher = step[axis] > 0.0;
  const double first = to_higher ? std::ceil(g[axis]) - g[axis] : g[axis] - std::floor(g[axis]);
  SampleReader reader(grid);
  for (int layer = 0; layer < kLayers; ++layer) {
    const Eigen::Array3d at = (g + (first + layer) * step).array() + 0.5;
    if ((at < 0.0).any()) break;
    const Vector3i corner = at.cast<int>();
    const std::optional<double> sample = reader.at(corner);
    if (!sample) break;
    visit(Sample{corner.cast<double>(), *sample,
                 grid.rounding() + std::numeric_limits<float>::epsilon() * std::abs(*sample)});
  }
}

Vector3d inCells(const GridShape& shape, const Vector3d& p_F) {
  return (p_F - shape.origin) / shape.cell;
}

}  // namespace

DistanceBounds sampleBracket(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient) {
  const Vector3d g = inCells(grid.shape(), p_F);
  const auto reach = [&](const Sample& s) { return (s.corner - g).norm() * grid.shape().cell + s.rounding; };
  DistanceBounds bounds{-kInfinity, kInfinity};
  visitSamples(grid, g, gradient, [&](const Sample& s) { bounds.low = std::max(bounds.low, s.value - reach(s)); });
  visitSamples(grid, g, -gradient, [&](const Sample& s) { bounds.high = std::min(bounds.high, s.value + reach(s)); });
  return bounds;
}

std::optional<LowerCone> sampleCone(const SparseGrid& grid, const Vector3d& p_F, const Vector3d& gradient) {
  const GridShape& shape = grid.shape();
  std::optional<LowerCone> highest;
  visitSamples(grid, inCells(shape, p_F), gradient, [&](const Sample& s) {
    const LowerCone cone{shape.origin + shape.cell * s.corner, s.value - s.rounding};
    if (!highest || cone(p_F) > (*highest)(p_F)) highest = cone;
  });
  return highest;
}

}  // namespace sdf_ccd
