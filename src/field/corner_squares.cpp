#include "corner_squares.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "common/lattice.h"

namespace sdf_ccd {
namespace {

/// Replaces runs of occupied voxels by those of the free voxels between and beyond them.
void takeRest(std::vector<VoxelSolid::Run>& runs) {
  constexpr int kFar = 1 << 20;
  std::vector<VoxelSolid::Run> rest;
  int begin = -kFar;
  for (const VoxelSolid::Run& run : runs) {
    rest.push_back({begin, run.begin});
    begin = run.end;
  }
  rest.push_back({begin, kFar});
  runs = std::move(rest);
}

}  // namespace

void CornerSquares::compute(int column, std::vector<float>& squares) const {
  const int from = column * kWidth, width = std::min(kWidth, corners_.x() - from);
  const int ring = to_occupied_ ? 0 : 1;  // all voxels outside the box are free
  std::vector<VoxelSolid::Run> runs;
  std::vector<Row> rows;
  std::vector<float> layer(static_cast<std::size_t>(kWidth) * static_cast<std::size_t>(corners_.y()));
  for (int z = -ring; z < solid_.count().z() + ring; ++z) {
    rows.clear();
    for (int y = -ring; y < solid_.count().y() + ring; ++y) {
      solid_.runs(y, z, runs);
      if (!to_occupied_) takeRest(runs);
      if (runs.empty()) continue;
      rows.push_back({y, {}});
      alongX(runs, from, width, rows.back().squares);
    }
    if (rows.empty()) continue;
    for (int y = 0; y < corners_.y(); ++y) alongY(rows, y, width, layer.data() + kWidth * y);
    for (int cz = 0; cz < corners_.z(); ++cz) {
      const float away = squaredGap(z, low_.z() + GridShape::kBrick * cz);
      for (int y = 0; y < corners_.y(); ++y) {
        float* const to = squares.data() + indexIn(corners_, {from, y, cz});
        const float* const of = layer.data() + kWidth * y;
        for (int x = 0; x < width; ++x) to[x] = std::min(to[x], of[x] + away);
      }
    }
  }
}

float CornerSquares::squaredGap(int voxel, int corner) const {
  const auto gap = static_cast<float>(std::max({0, n_ * voxel - corner, corner - n_ * (voxel + 1)}));
  return gap * gap;
}

void CornerSquares::alongX(const std::vector<VoxelSolid::Run>& runs, int from, int width,
                           std::array<float, kWidth>& squares) const {
  std::size_t next = 0;  // the first run that does not end before the corner
  for (int x = 0; x < width; ++x) {
    const int corner = low_.x() + GridShape::kBrick * (from + x);
    while (next < runs.size() && n_ * runs[next].end < corner) ++next;
    int gap = std::numeric_limits<int>::max();
    if (next < runs.size()) gap = std::max(0, n_ * runs[next].begin - corner);
    if (next > 0) gap = std::min(gap, corner - n_ * runs[next - 1].end);
    squares[static_cast<std::size_t>(x)] = static_cast<float>(gap) * static_cast<float>(gap);
  }
}

/// Visits the nearest rows first, and stops where rows are too far away to matter.
void CornerSquares::alongY(const std::vector<Row>& rows, int y, int width, float* best) const {
  std::fill_n(best, width, std::numeric_limits<float>::infinity());
  const int corner = low_.y() + GridShape::kBrick * y;
  const auto middle =
      std::lower_bound(rows.begin(), rows.end(), corner, [&](const Row& row, int value) { return n_ * row.y < value; });
  auto behind = middle, before = middle;
  while (behind != rows.end() || before != rows.begin()) {
    const bool is_behind = before == rows.begin() || (behind != rows.end() && squaredGap(behind->y, corner) <=
                                                                                  squaredGap((before - 1)->y, corner));
    const Row& row = is_behind ? *behind++ : *--before;
    const float away = squaredGap(row.y, corner);
    if (away >= *std::max_element(best, best + width)) return;
    for (int x = 0; x < width; ++x) best[x] = std::min(best[x], row.squares[static_cast<std::size_t>(x)] + away);
  }
}

}  // namespace sdf_ccd
