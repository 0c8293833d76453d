#pragma once

#include <vector>

#include "field/adaptive/adaptive_grid.h"
#include "field/uniform/sparse_grid.h"
#include "sdf_ccd/primitive.h"
#include "sdf_ccd/segments.h"

/// The segment query for each kind of field that a DistanceField can hold. The options only say where to stop early;
/// segmentIntervals() removes any further intervals.
namespace sdf_ccd {

/// Two consecutive spans with a smaller gap than this on the path are merged: two cells agree on their common face only
/// up to rounding.
constexpr double kJoin = 1e-12;

/// Appends a span; merges it with the last one if they touch.
inline void appendSpan(Intervals& intervals, double enter, double exit) {
  if (!intervals.empty() && enter <= intervals.back().exit + kJoin) {
    if (exit > intervals.back().exit) intervals.back().exit = exit;
  } else {
    intervals.push_back({enter, exit});
  }
}

/// Whether a query stops where the first interval begins.
inline bool stopsAtEnter(SegmentMode mode) {
  return mode == SegmentMode::kFirst || mode == SegmentMode::kAny;
}

/// Whether a query that has come to the parameter t has what its mode asks for.
inline bool isAnswered(SegmentMode mode, const Intervals& intervals, double t) {
  if (intervals.empty()) return false;
  // The first interval is complete once t is beyond its end.
  return stopsAtEnter(mode) || (mode == SegmentMode::kFirstInterval && t > intervals.front().exit + kJoin);
}

/// Throws std::invalid_argument unless |sigma| ≤ field.band().
void checkIsovalue(const DistanceField& field, double sigma);

void gridIntervals(const SparseGrid& grid, const Segment& segment, const SegmentOptions& options, Intervals& intervals);
void gridPieces(const SparseGrid& grid, const Segment& segment, const Interval& interval, std::vector<double>& breaks);

void adaptiveIntervals(const AdaptiveGrid& grid, const Segment& segment, const SegmentOptions& options,
                       Intervals& intervals);
void adaptivePieces(const AdaptiveGrid& grid, const Segment& segment, const Interval& interval,
                    std::vector<double>& breaks);

void primitiveIntervals(const Primitive& primitive, const Segment& segment, const SegmentOptions& options,
                        Intervals& intervals);
void primitivePieces(const Primitive& primitive, const Segment& segment, const Interval& interval,
                     std::vector<double>& breaks);

}  // namespace sdf_ccd
