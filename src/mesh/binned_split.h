#pragma once

#include <array>

#include "box_measures.h"
#include "common/infinity.h"

namespace sdf_ccd {

constexpr int kBins = 16;
/// At greater depths, ranges are split in half regardless of cost: the depth stays below kHeuristicDepth + 31.
constexpr int kHeuristicDepth = 64;

/// Boxes and counts of the elements of a range in each of kBins equal parts of its extent.
struct Bins {
  std::array<AlignedBox3d, kBins> boxes;
  std::array<int, kBins> counts{};

  /// First bin of the second part, for the split with the lowest cost by the surface area heuristic (Wald 2007); 0 if
  /// one bin holds all.
  int bestSplit() const {
    std::array<double, kBins> cost_above{};
    AlignedBox3d box;
    int count = 0;
    for (int bin = kBins - 1; bin > 0; --bin) {
      box.extend(boxes[bin]);
      count += counts[bin];
      cost_above[bin] = count > 0 ? count * halfArea(box) : 0.0;
    }
    const int all = count + counts[0];
    double least = kInfinity;
    int best = 0;
    box.setEmpty();
    count = 0;
    for (int bin = 1; bin < kBins; ++bin) {
      box.extend(boxes[bin - 1]);
      count += counts[bin - 1];
      if (count == 0 || count == all) continue;
      const double cost = count * halfArea(box) + cost_above[bin];
      if (cost < least) {
        least = cost;
        best = bin;
      }
    }
    return best;
  }
};

}  // namespace sdf_ccd
