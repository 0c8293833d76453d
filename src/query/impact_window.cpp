#include "sdf_ccd/query/least_distance.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

constexpr int kSteps = 64;       ///< at most; along a surface balls are many, and the window is only wider without them
constexpr double kClose = 1e-2;  ///< of the error: nearer than this to its bound is at it

class Way {
 public:
  Way(const DistanceField& field, const Segment& segment)
      : field_(field), start_(segment.start), way_(segment.end - segment.start), length_(way_.norm()) {}

  FieldSample sample(double t) const { return field_.sample(start_ + t * way_); }
  double length() const { return length_; }

 private:
  const DistanceField& field_;
  Vector3d start_, way_;
  double length_;
};

/// From a time before which nothing is met, on through balls without surface; beyond 1 if they reach there.
double freeUntil(const Way& way, double t) {
  for (int i = 0; i < kSteps && t <= 1.0; ++i) {
    const FieldSample at = way.sample(t);
    const double free = at.value - at.error;
    if (free <= kClose * at.error || way.length() == 0.0) break;
    t += free / way.length() * (1.0 - 1e-9);
  }
  return t;
}

/// A place that is surely inside, near the first one after `t`, no later than `end`: by steps that double, then halve.
std::optional<double> insideAfter(const Way& way, double t, double end) {
  const auto outside = [&](double s) {
    const FieldSample at = way.sample(s);
    return at.value + at.error > 0.0;
  };
  if (!outside(t)) return t;
  double step = way.length() > 0.0 ? way.sample(t).error / way.length() : end - t;
  double before = t;
  for (int i = 0; i < kSteps; ++i, step *= 2.0) {
    const double next = std::min(before + step, end);
    if (!outside(next)) {
      double inside = next;
      for (int halved = 0; halved < 6; ++halved) {
        const double middle = 0.5 * (before + inside);
        (outside(middle) ? before : inside) = middle;
      }
      return inside;
    }
    if (next == end) return std::nullopt;
    before = next;
  }
  return std::nullopt;
}

}  // namespace

std::optional<ImpactWindow> impactWindow(const DistanceField& field, const Segment& segment) {
  const double error = std::min(field.errorBound(), field.band());
  const auto first = [&](double sigma) {
    const Intervals found = segmentIntervals(field, segment, {sigma, SegmentMode::kFirst});
    return found.empty() ? std::optional<double>() : found.front().enter;
  };
  const std::optional<double> near = first(error);
  if (!near) return std::nullopt;
  const Way way(field, segment);
  ImpactWindow window{freeUntil(way, *near), {}, {}};
  if (window.earliest > 1.0) return std::nullopt;
  window.time = first(0.0);
  const std::optional<double> deep = first(-error);
  window.latest = insideAfter(way, window.time.value_or(window.earliest), deep.value_or(1.0));
  if (!window.latest) window.latest = deep;
  if (window.time) window.earliest = std::min(window.earliest, *window.time);
  return window;
}

}  // namespace sdf_ccd
