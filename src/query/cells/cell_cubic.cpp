#include "cell_cubic.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "query/bracketed_root.h"

namespace sdf_ccd {
namespace {

/// Extrema of the cubic within (0, 1), increasing.
struct Extrema {
  std::array<double, 2> u;
  int count = 0;
};

Extrema extrema(const CellCubic& f) {
  // Roots of 3 c3 u² + 2 c2 u + c1, by the form that does not cancel.
  const double a = 3.0 * f.c[3], half_b = f.c[2], c = f.c[1];
  Extrema found;
  const auto add = [&](double u) {
    if (u > 0.0 && u < 1.0) found.u[found.count++] = u;
  };
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0.0) return found;
  const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
  if (q != 0.0) add(c / q);
  if (a != 0.0) add(q / a);
  if (found.count == 2 && found.u[0] > found.u[1]) std::swap(found.u[0], found.u[1]);
  return found;
}

}  // namespace

CellCubic cellCubic(const std::array<double, 8>& corners, const Vector3d& from, const Vector3d& to, double sigma) {
  const Vector3d d = to - from;
  CellCubic cubic{cubicAlong(corners, {from.x(), from.y(), from.z()}, {d.x(), d.y(), d.z()})};
  cubic.c[0] -= sigma;
  return cubic;
}

CellIntervals nonPositive(const CellCubic& f) {
  CellIntervals result;
  const double touch = 4.0 * std::numeric_limits<double>::epsilon() *
                       (std::abs(f.c[0]) + std::abs(f.c[1]) + std::abs(f.c[2]) + std::abs(f.c[3]));
  const Extrema extremes = extrema(f);
  std::array<double, 4> u{0.0, 0.0, 0.0, 0.0};
  int count = 1;
  for (int i = 0; i < extremes.count; ++i) u[count++] = extremes.u[i];
  u[count++] = 1.0;

  bool inside = false;
  double enter = 0.0;
  double value = f(0.0);
  if (value <= 0.0) inside = true;
  const auto root = [&](double lo, double hi, bool rising) {
    return bracketedRoot([&](double t) { return ValueSlope{f(t), f.slope(t)}; }, lo, hi, rising);
  };
  for (int i = 1; i < count; ++i) {
    const double next = f(u[i]);
    if (inside && next > 0.0) {
      result.interval[result.count++] = {enter, value == 0.0 ? u[i - 1] : root(u[i - 1], u[i], true)};
      inside = false;
    } else if (!inside && next <= 0.0) {
      enter = next == 0.0 ? u[i] : root(u[i - 1], u[i], false);
      inside = true;
    } else if (!inside && next <= touch && i + 1 < count && f(u[i + 1]) > next) {
      result.interval[result.count++] = {u[i], u[i]};
    }
    value = next;
  }
  if (inside) result.interval[result.count++] = {enter, 1.0};
  return result;
}

CubicMinimum minimumOf(const CellCubic& f) {
  // The Bézier coefficients of the slope: where all have one sign, it has.
  const double first = f.c[1], middle = f.c[1] + f.c[2], last = middle + f.c[2] + 3.0 * f.c[3];
  if (first >= 0.0 && middle >= 0.0 && last >= 0.0) return {0.0, f(0.0)};
  if (first <= 0.0 && middle <= 0.0 && last <= 0.0) return {1.0, f(1.0)};
  CubicMinimum lowest{0.0, f(0.0)};
  const auto offer = [&](double u) {
    const double value = f(u);
    if (value < lowest.value) lowest = {u, value};
  };
  const Extrema extremes = extrema(f);
  for (int i = 0; i < extremes.count; ++i) offer(extremes.u[i]);
  offer(1.0);
  return lowest;
}

}  // namespace sdf_ccd
