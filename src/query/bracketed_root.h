#pragma once

#include <cmath>

namespace sdf_ccd {

/// A value and its derivative.
struct ValueSlope {
  double value;
  double slope;
};

/// Root of a continuous f in [lo, hi], where f(lo) and f(hi) lie on different sides of zero: by Newton's method as long
/// as its steps stay in the bracket and shrink it, else by bisection. Accurate to the last bits of the parameter.
/// @param f         returns ValueSlope at a parameter.
/// @param rising    true if f(lo) < 0 < f(hi).
template <class Function>
double bracketedRoot(const Function& f, double lo, double hi, bool rising) {
  double t = 0.5 * (lo + hi);
  for (int i = 0; i < 100; ++i) {
    const ValueSlope at = f(t);
    if (at.value == 0.0) return t;
    const double before = hi - lo;
    ((at.value < 0.0) == rising ? lo : hi) = t;
    if (hi - lo <= 1e-16 + 2e-16 * std::abs(t)) break;
    const double newton = t - at.value / at.slope;
    // Halve if Newton's step leaves the bracket (also when the slope is zero) or the bracket hardly shrinks.
    const bool use_newton = newton > lo && newton < hi && (i < 4 || hi - lo < 0.75 * before);
    const double next = use_newton ? newton : 0.5 * (lo + hi);
    if (std::abs(next - t) <= 1e-16 + 1e-16 * std::abs(t)) return next;
    t = next;
  }
  return t;
}

}  // namespace sdf_ccd
