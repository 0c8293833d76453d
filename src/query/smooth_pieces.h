#pragma once

#include <vector>

#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// Sorts intervals and joins those that overlap or lie within `gap` of each other.
void mergeIntervals(Intervals& intervals, double gap = 0.0);

/// Parameters in (enter, exit), increasing, where the segment passes from one cell of the field to the next:
/// between them the interpolated field is a cubic of the parameter (a quadrature that is exact for it, design §3.9).
/// For a primitive: where the distance may have a kink, or a few evenly spaced for curved ones.
void smoothPieces(const DistanceField& field, const Segment& segment, const Interval& interval,
                  std::vector<double>& breaks);

}  // namespace sdf_ccd
