#include "least_distance.h"

#include <algorithm>

namespace sdf_ccd {
namespace {

constexpr int kSteps = 64;       ///< upper bound; stopping early only widens the window
constexpr double kClose = 1e-2;  ///< relative to the error: the advance ends where the empty sphere is smaller

class Path {
 public:
  Path(const DistanceField& field, const Segment& segment)
      : field_(field),
        start_(segment.start),
        displacement_(segment.end - segment.start),
        length_(displacement_.norm()) {}

  FieldSample sample(double t) const { return field_.sample(start_ + t * displacement_); }
  double length() const { return length_; }

 private:
  const DistanceField& field_;
  Vector3d start_, displacement_;
  double length_;
};

/// Advances through empty spheres, from a time before which there is no contact, to a later such time; above 1 if there
/// is no contact up to the end.
double freeUntil(const Path& path, double t) {
  for (int i = 0; i < kSteps && t <= 1.0; ++i) {
    const FieldSample at = path.sample(t);
    const double free = at.value - at.error;
    if (free <= kClose * at.error || path.length() == 0.0) break;
    t += free / path.length() * (1.0 - 1e-9);
  }
  return t;
}

/// A time in [t, end] at which the point surely is inside, close to the first such time: found with doubling steps,
/// then bisection. std::nullopt if none is found.
std::optional<double> insideAfter(const Path& path, double t, double end) {
  const auto outside = [&](double s) {
    const FieldSample at = path.sample(s);
    return at.value + at.error > 0.0;
  };
  if (!outside(t)) return t;
  double step = path.length() > 0.0 ? path.sample(t).error / path.length() : end - t;
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
  const double error = field.errorBound();
  const auto first = [&](double sigma) {
    const Intervals found = segmentIntervals(field, segment, {sigma, SegmentMode::kFirst});
    return found.empty() ? std::optional<double>() : found.front().enter;
  };
  if (error > field.band()) return ImpactWindow{0.0, first(0.0), {}};  // no isosurface that far out is known
  const std::optional<double> near = first(error);
  if (!near) return std::nullopt;
  const Path path(field, segment);
  ImpactWindow window{freeUntil(path, *near), {}, {}};
  if (window.earliest > 1.0) return std::nullopt;
  window.time = first(0.0);
  const std::optional<double> deep = first(-error);
  window.latest = insideAfter(path, window.time.value_or(window.earliest), deep.value_or(1.0));
  if (!window.latest) window.latest = deep;
  if (window.time) window.earliest = std::min(window.earliest, *window.time);
  return window;
}

}  // namespace sdf_ccd
