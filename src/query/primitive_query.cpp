#include <algorithm>
#include <cmath>
#include <limits>

#include "bracketed_root.h"
#include "representation_queries.h"

namespace sdf_ccd {
namespace {

/// Distance minus isovalue along the segment: convex, because the solid is.
struct ConvexLine {
  const Primitive& primitive;
  const Segment& segment;
  double sigma;

  Vector3d point(double t) const { return segment.start + t * (segment.end - segment.start); }
  double value(double t) const { return signedDistance(primitive, point(t)) - sigma; }
  ValueSlope operator()(double t) const {
    const Vector3d p = point(t);
    return {signedDistance(primitive, p) - sigma, distanceGradient(primitive, p).dot(segment.end - segment.start)};
  }
};

/// A parameter where the function is not positive (up to rounding), found by intersecting a falling and a rising
/// tangent (cutting planes); negative if the tangents prove that there is none.
double nonPositiveParameter(const ConvexLine& f, double touch) {
  double lo = 0.0, hi = 1.0;
  ValueSlope at_lo = f(lo), at_hi = f(hi);
  if (at_lo.slope >= 0.0 || at_hi.slope <= 0.0) return -1.0;
  for (int i = 0; i < 200; ++i) {
    // The intersection of the tangents is the lowest point that convexity allows.
    const double width = hi - lo;
    const double meet = lo + (at_hi.value - at_lo.value - at_hi.slope * width) / (at_lo.slope - at_hi.slope);
    const double bound = at_lo.value + at_lo.slope * (meet - lo);
    if (bound > touch) return -1.0;
    const double t = i % 3 == 2 || !(meet > lo && meet < hi) ? 0.5 * (lo + hi) : meet;
    const ValueSlope at = f(t);
    if (at.value <= touch) return t;
    if (hi - lo < 1e-15) return -1.0;
    if (at.slope < 0.0) {
      lo = t;
      at_lo = at;
    } else if (at.slope > 0.0) {
      hi = t;
      at_hi = at;
    } else {
      return -1.0;  // this is the minimum, and it is positive
    }
  }
  return -1.0;
}

}  // namespace

void primitiveIntervals(const Primitive& primitive, const Segment& segment, const SegmentOptions& options,
                        Intervals& intervals) {
  const ConvexLine f{primitive, segment, options.sigma};
  const double at_start = f.value(0.0), at_end = f.value(1.0);
  if (at_start <= 0.0 && at_end <= 0.0) {
    intervals.push_back({0.0, 1.0});
    return;
  }
  const double size = std::max(segment.start.lpNorm<Eigen::Infinity>(), segment.end.lpNorm<Eigen::Infinity>());
  const double touch = 4.0 * std::numeric_limits<double>::epsilon() * (size + std::abs(options.sigma));
  double inside = at_start <= 0.0 ? 0.0 : at_end <= 0.0 ? 1.0 : nonPositiveParameter(f, touch);
  if (inside < 0.0) return;
  if (f.value(inside) > 0.0) {
    intervals.push_back({inside, inside});
    return;
  }
  const double enter = at_start <= 0.0 ? 0.0 : bracketedRoot(f, 0.0, inside, false);
  const double exit = at_end <= 0.0 ? 1.0 : bracketedRoot(f, inside, 1.0, true);
  intervals.push_back({std::min(enter, exit), exit});
}

void primitivePieces(const Primitive& primitive, const Segment& segment, const Interval& interval,
                     std::vector<double>& breaks) {
  if (isHalfSpace(primitive)) return;
  const auto add = [&](double t) {
    if (t > interval.enter && t < interval.exit) breaks.push_back(t);
  };
  if (const Box* box = std::get_if<Box>(&primitive)) {
    // Inside, the distance is the largest of six linear functions, with kinks where two of them are equal.
    const Vector3d d = segment.end - segment.start;
    for (int i = 0; i < 6; ++i) {
      for (int j = i + 1; j < 6; ++j) {
        const auto face = [&](int n) { return std::pair<int, double>{n / 2, n % 2 ? -1.0 : 1.0}; };
        const auto [a, sa] = face(i);
        const auto [b, sb] = face(j);
        const double slope = sa * d[a] - sb * d[b];
        if (slope == 0.0) continue;
        add(((box->half_size[a] - sa * segment.start[a]) - (box->half_size[b] - sb * segment.start[b])) / slope);
      }
    }
    std::sort(breaks.begin(), breaks.end());
    return;
  }
  constexpr int kPieces = 8;
  for (int i = 1; i < kPieces; ++i) add(interval.enter + (interval.exit - interval.enter) * i / kPieces);
}

}  // namespace sdf_ccd
