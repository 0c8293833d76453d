#pragma once

#include <vector>

namespace sdf_ccd {

/// Closed interval of a parameter; enter ≤ exit.
struct Interval {
  double enter;
  double exit;
};

/// Disjoint and increasing.
using Intervals = std::vector<Interval>;

/// Sorts intervals and joins those that overlap or lie within `gap` of each other.
void mergeIntervals(Intervals& intervals, double gap = 0.0);

}  // namespace sdf_ccd
