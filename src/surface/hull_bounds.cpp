#include "hull_bounds.h"

namespace sdf_ccd {

void HullBounds::add(const HullValues& values, const DepthPlane& plane) {
  if (count_ == kMostBounds) return;
  bounds_[count_] = values;
  planes_[count_] = plane;
  ++count_;
  findBestWeights();
}

bool HullBounds::addPlane(const DepthPlane& plane) {
  HullValues values;
  for (int k = 0; k < 6; ++k) {
    if (!plane.holdsAt(hull_.corners[k])) return false;
    values[k] = plane.depthBehind(hull_.corners[k]);
  }
  add(values, plane);
  return true;
}

/// The weights for which the largest mean at a corner is smallest: a matrix game, solved as a linear program by the
/// simplex method (Dantzig 1951). Whatever weights it ends with, their mean is an upper bound.
void HullBounds::findBestWeights() {
  constexpr int kMaxPivots = 40;
  constexpr double kZero = 1e-12;
  double least = kInfinity, most = -kInfinity;
  for (std::size_t i = 0; i < count_; ++i)
    for (const double value : bounds_[i]) {
      least = std::min(least, value);
      most = std::max(most, value);
    }
  const double scale = most > least ? 1.0 / (most - least) : 0.0;
  // Per corner a row: the scaled bounds, then the slack variables, then the limit 1. The last row is the objective.
  constexpr std::size_t kRows = 6, kColumns = kMostBounds + 6;
  std::array<std::array<double, kColumns + 1>, kRows + 1> table{};
  std::array<std::size_t, kRows> basis;
  for (std::size_t row = 0; row < kRows; ++row) {
    for (std::size_t i = 0; i < count_; ++i) table[row][i] = 1.0 + scale * (bounds_[i][row] - least);
    table[row][kMostBounds + row] = table[row][kColumns] = 1.0;
    basis[row] = kMostBounds + row;
  }
  for (std::size_t i = 0; i < count_; ++i) table[kRows][i] = -1.0;
  for (int pivot = 0; pivot < kMaxPivots; ++pivot) {
    const auto& objective = table[kRows];
    const std::size_t column = std::min_element(objective.begin(), objective.begin() + kColumns) - objective.begin();
    if (!(objective[column] < -kZero)) break;
    std::size_t out = kRows;
    double ratio = kInfinity;
    for (std::size_t row = 0; row < kRows; ++row) {
      if (!(table[row][column] > kZero)) continue;
      const double of_row = table[row][kColumns] / table[row][column];
      if (of_row < ratio) out = row;
      ratio = std::min(ratio, of_row);
    }
    if (out == kRows) break;
    basis[out] = column;
    const double inverse = 1.0 / table[out][column];
    for (double& entry : table[out]) entry *= inverse;
    for (std::size_t row = 0; row <= kRows; ++row) {
      const double factor = table[row][column];
      if (row == out || factor == 0.0) continue;
      for (std::size_t k = 0; k <= kColumns; ++k) table[row][k] -= factor * table[out][k];
    }
  }
  std::array<double, kMostBounds> weights{};
  HullValues place{};
  double all_weights = 0.0, all_shares = 0.0;
  for (std::size_t row = 0; row < kRows; ++row) {
    if (basis[row] < kMostBounds) all_weights += weights[basis[row]] = std::max(0.0, table[row][kColumns]);
    all_shares += place[row] = std::max(0.0, table[kRows][kMostBounds + row]);
  }
  if (!(all_weights > 0.0 && all_shares > 0.0)) return;
  double bound = -kInfinity;
  for (std::size_t row = 0; row < kRows; ++row) {
    double mean = 0.0;
    for (std::size_t i = 0; i < count_; ++i) mean += weights[i] / all_weights * bounds_[i][row];
    bound = std::max(bound, mean);
    place_[row] = place[row] / all_shares;
  }
  weights_ = weights;
  value_ = std::min(value_, bound);
}

}  // namespace sdf_ccd
