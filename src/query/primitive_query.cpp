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

/// The distance of a moving point from a center, or from an axis that it is projected along.
class RoundLine {
 public:
  /// @param start  from the center. @param displacement  over the parameters 0 to 1.
  RoundLine(const Vector3d& start, const Vector3d& displacement)
      : a_(displacement.squaredNorm()), b_(start.dot(displacement)), c_(start.squaredNorm()) {}

  /// Adds the parameter where the distance is least, and those that cut the interval where it turns, if it does so
  /// there. The distance is smooth but for the complex parameters nearest ± i least, where it is 0: three-point Gauss
  /// has a relative error below 1e-6 on an interval that is three times its length away from them.
  template <class Add>
  void addTurns(const Interval& interval, const Add& add) const {
    constexpr double kFar = 3.0;
    constexpr int kPieces = 8;
    if (!(a_ > 0.0)) return;
    const double length = interval.exit - interval.enter;
    const double nearest = -b_ / a_, least = std::sqrt(std::max(0.0, c_ + b_ * nearest) / a_);
    add(nearest);
    const double before = std::max({0.0, interval.enter - nearest, nearest - interval.exit});
    if (before * before + least * least >= kFar * kFar * length * length) return;
    for (int i = 1; i < kPieces; ++i) add(interval.enter + length * i / kPieces);
    // The direction to the center turns by 90 degrees while the point moves by twice its least distance.
    for (const double share : {0.25, 0.5, 1.0, 2.0, 4.0, 8.0}) {
      add(nearest - share * least);
      add(nearest + share * least);
    }
  }

  /// Adds the parameters t at which the distance is ± (offset + slope t).
  template <class Add>
  void addCrossings(double offset, double slope, const Add& add) const {
    const double a = a_ - slope * slope, b = b_ - offset * slope, c = c_ - offset * offset;
    const double discriminant = b * b - a * c, rounding = 16.0 * std::numeric_limits<double>::epsilon() * b * b;
    if (!(discriminant >= -rounding)) return;
    const double s = -(b + std::copysign(std::sqrt(std::max(discriminant, 0.0)), b));  // the form that does not cancel
    if (a != 0.0) add(s / a);
    if (s != 0.0) add(c / s);
  }

 private:
  double a_, b_, c_;  // of the squared distance, a t² + 2 b t + c
};

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
  // The distance is 1-Lipschitz: this far from both ends, the segment does not reach the isosurface.
  const double reach = at_start + at_end - 2.0 * touch;
  if (std::min(at_start, at_end) > touch && reach * reach > (segment.end - segment.start).squaredNorm()) return;
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
    const Vector3d d = segment.end - segment.start, half = box->halfSize();
    for (int i = 0; i < 6; ++i) {
      for (int j = i + 1; j < 6; ++j) {
        const auto face = [&](int n) { return std::pair<int, double>{n / 2, n % 2 ? -1.0 : 1.0}; };
        const auto [a, sa] = face(i);
        const auto [b, sb] = face(j);
        const double slope = sa * d[a] - sb * d[b];
        if (slope == 0.0) continue;
        add(((half[a] - sa * segment.start[a]) - (half[b] - sb * segment.start[b])) / slope);
      }
    }
    std::sort(breaks.begin(), breaks.end());
    return;
  }
  const Cylinder* cylinder = std::get_if<Cylinder>(&primitive);
  const Vector3d across(1.0, 1.0, cylinder ? 0.0 : 1.0);  // the axes in which the surface is round
  const RoundLine line(segment.start.cwiseProduct(across), (segment.end - segment.start).cwiseProduct(across));
  line.addTurns(interval, add);
  if (cylinder) {
    // Inside, the distance is the larger one of that from the side and those from both caps.
    const double z = segment.start.z(), slope = segment.end.z() - z;
    if (slope != 0.0) add(-z / slope);
    const double free = cylinder->radius - cylinder->halfLength();
    line.addCrossings(free + z, slope, add);
    line.addCrossings(free - z, -slope, add);
  }
  std::sort(breaks.begin(), breaks.end());
}

}  // namespace sdf_ccd
