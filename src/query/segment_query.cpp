#include "sdf_ccd/segments.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "common/number_text.h"
#include "field/field_access.h"
#include "query/smooth_pieces.h"
#include "query/swept_side.h"
#include "representation_queries.h"
#include "segment_reach.h"

namespace sdf_ccd {

void checkIsovalue(const DistanceField& field, double sigma) {
  if (std::abs(sigma) <= field.band()) return;
  throw std::invalid_argument("segment query: isovalue " + numberText(sigma) + " m lies outside the field's band of " +
                              numberText(field.band()) + " m");
}

void segmentIntervals(const DistanceField& field, const Segment& segment, const SegmentOptions& options,
                      Intervals& intervals) {
  intervals.clear();
  requireWithinReach(segment, "segment query");
  checkIsovalue(field, options.sigma);
  if (const Primitive* primitive = field.primitive()) {
    primitiveIntervals(*primitive, segment, options, intervals);
  } else if (const AdaptiveGrid* adaptive = FieldAccess::adaptive(field)) {
    adaptiveIntervals(*adaptive, segment, options, intervals);
  } else {
    gridIntervals(*FieldAccess::grid(field), segment, options, intervals);
  }
  if (options.mode != SegmentMode::kAll && intervals.size() > 1) intervals.resize(1);
  if (stopsAtEnter(options.mode) && !intervals.empty()) intervals.front().exit = intervals.front().enter;
}

Intervals segmentIntervals(const DistanceField& field, const Segment& segment, const SegmentOptions& options) {
  Intervals intervals;
  segmentIntervals(field, segment, options, intervals);
  return intervals;
}

SweptSide sweptSide(const DistanceField& field, const Segment& segment, double margin) {
  const Vector3d d = segment.end - segment.start;
  const double length = d.norm();
  // Most segments are short: one sphere around the middle contains all of it.
  const DistanceBounds at_middle = field.bounds(segment.start + 0.5 * d);
  const double middle = at_middle.low - margin;
  if (middle > 0.5 * length) return SweptSide::kOutside;
  if (at_middle.high < -(margin + 0.5 * length)) return SweptSide::kInside;
  if (middle <= 0.0) return SweptSide::kUnknown;
  // From one empty sphere to the next. After too many steps, the answer is the conservative one.
  constexpr int kMaxBalls = 64;
  double at = 0.0;
  for (int i = 0; i < kMaxBalls; ++i) {
    const double free = field.lowerBound(segment.start + (at / length) * d) - margin;
    if (free <= 0.0) return SweptSide::kUnknown;
    at += free;
    if (at > length) return SweptSide::kOutside;
  }
  return SweptSide::kUnknown;
}

bool mayTouch(const DistanceField& field, const Segment& segment, double radius) {
  return sweptSide(field, segment, radius) != SweptSide::kOutside;
}

void smoothPieces(const DistanceField& field, const Segment& segment, const Interval& interval,
                  std::vector<double>& breaks) {
  breaks.clear();
  if (const Primitive* primitive = field.primitive()) {
    primitivePieces(*primitive, segment, interval, breaks);
  } else if (const AdaptiveGrid* adaptive = FieldAccess::adaptive(field)) {
    adaptivePieces(*adaptive, segment, interval, breaks);
  } else {
    gridPieces(*FieldAccess::grid(field), segment, interval, breaks);
  }
}

}  // namespace sdf_ccd
