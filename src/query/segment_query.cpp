#include "sdf_ccd/query/segment_query.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "representation_queries.h"

namespace sdf_ccd {

void segmentIntervals(const DistanceField& field, const Segment& segment, const SegmentOptions& options,
                      Intervals& intervals) {
  intervals.clear();
  if (!isWithinReach(segment)) {
    throw std::invalid_argument("segment query: the segment is not finite, or reaches farther than 1e12 m");
  }
  if (!(std::abs(options.sigma) <= field.band())) {
    throw std::invalid_argument("segment query: isovalue " + std::to_string(options.sigma) +
                                " m lies outside the field's band of " + std::to_string(field.band()) + " m");
  }
  if (const Primitive* primitive = field.primitive()) {
    primitiveIntervals(*primitive, segment, options, intervals);
  } else if (const AdaptiveGrid* adaptive = field.adaptive()) {
    adaptiveIntervals(*adaptive, segment, options, intervals);
  } else {
    gridIntervals(*field.grid(), segment, options, intervals);
  }
}

Intervals segmentIntervals(const DistanceField& field, const Segment& segment, const SegmentOptions& options) {
  Intervals intervals;
  segmentIntervals(field, segment, options, intervals);
  return intervals;
}

bool mayTouch(const DistanceField& field, const Segment& segment, double radius) {
  const Vector3d d = segment.end - segment.start;
  const double length = d.norm();
  // Most segments are short: one ball around the middle holds all of it.
  const double middle = field.lowerBound(segment.start + 0.5 * d) - radius;
  if (middle > 0.5 * length) return false;
  if (middle <= 0.0) return true;
  // From ball to ball. Each is free of places nearer than `radius`; after too many, the answer is the safe one.
  constexpr int kMaxBalls = 64;
  double at = 0.0;
  for (int i = 0; i < kMaxBalls; ++i) {
    const double free = field.lowerBound(segment.start + (at / length) * d) - radius;
    if (free <= 0.0) return true;
    at += free;
    if (at > length) return false;
  }
  return true;
}

bool surelyInside(const DistanceField& field, const Segment& segment, double depth) {
  const Vector3d d = segment.end - segment.start;
  return field.bounds(segment.start + 0.5 * d).high < -(depth + 0.5 * d.norm());
}

void smoothPieces(const DistanceField& field, const Segment& segment, const Interval& interval,
                  std::vector<double>& breaks) {
  breaks.clear();
  if (const Primitive* primitive = field.primitive()) {
    primitivePieces(*primitive, segment, interval, breaks);
  } else if (const AdaptiveGrid* adaptive = field.adaptive()) {
    adaptivePieces(*adaptive, segment, interval, breaks);
  } else {
    gridPieces(*field.grid(), segment, interval, breaks);
  }
}

}  // namespace sdf_ccd
