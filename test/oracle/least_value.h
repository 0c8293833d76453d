#pragma once

#include <algorithm>
#include <limits>
#include <queue>
#include <vector>

#include "oracle/long_screw.h"

/// The minimum of a function, certified from both sides.
namespace sdf_ccd::test {

struct LeastValue {
  Real low = 0;   ///< lower bound of the minimum
  Real high = 0;  ///< the function's value at `at`, an upper bound of the minimum
  Real at = 0;
};

struct LeastOptions {
  Real tolerance = 0;                                   ///< high − low aimed at
  Real above = std::numeric_limits<Real>::infinity();   ///< stops once low exceeds this
  Real below = -std::numeric_limits<Real>::infinity();  ///< stops once high is less than this
  int max_samples = 20000;
};

/// A function's value in the middle of an interval, and a lower bound in all of the interval.
struct LeastSample {
  Real value, low;
};

/// The minimum over [from, to]: intervals are halved, those with the smallest lower bound first (Piyavskii 1972).
/// @param sample  LeastSample(Real middle, Real half), for the interval [middle − half, middle + half].
template <class F>
LeastValue leastOfSamples(const F& sample, Real from, Real to, const LeastOptions& options) {
  struct Interval {
    Real low, middle, half;
    bool operator<(const Interval& other) const { return low > other.low; }
  };
  LeastValue least{0, std::numeric_limits<Real>::infinity(), from};
  std::priority_queue<Interval> queue;
  int samples = 0;
  const auto add = [&](Real middle, Real half) {
    const LeastSample found = sample(middle, half);
    ++samples;
    if (found.value < least.high) {
      least.high = found.value;
      least.at = middle;
    }
    queue.push({found.low, middle, half});
  };
  for (const Real end : {from, to}) {  // the ends themselves, so that a contact that only occurs there is found
    const Real value = sample(end, 0).value;
    if (value >= least.high) continue;
    least.high = value;
    least.at = end;
  }
  add((from + to) / 2, (to - from) / 2);
  for (;;) {
    const Interval first = queue.top();
    least.low = std::min(first.low, least.high);
    const bool done = least.high - least.low <= options.tolerance || least.low > options.above;
    if (done || least.high < options.below || samples >= options.max_samples) return least;
    queue.pop();
    add(first.middle - first.half / 2, first.half / 2);
    add(first.middle + first.half / 2, first.half / 2);
  }
}

/// The smallest value found at evenly spread places of [0, 1], and by a local search from the best of them: an upper
/// bound of the minimum.
/// @param f       Real(Real s, Real best); values above `best` need not be exact.
/// @param finest  step of the local search.
template <class F>
Real leastFound(const F& f, int samples, Real finest) {
  Real best = 1e300L, at = 0;
  const auto look = [&](Real s) {
    if (s < 0 || s > 1) return;
    const Real value = f(s, best);
    if (value < best) best = value, at = s;
  };
  for (int i = 0; i <= samples; ++i) look(Real(i) / samples);
  for (Real step = 0.5L / samples; step > finest; step /= 2) {
    look(at - step);
    look(at + step);
  }
  return best;
}

/// The minimum of a function that changes by at most `rate` per unit.
/// @param f  Real(Real); it may be less than the function with that rate: `low` still holds.
template <class F>
LeastValue leastValue(const F& f, Real from, Real to, Real rate, const LeastOptions& options) {
  const auto sample = [&](Real middle, Real half) {
    const Real value = f(middle);
    return LeastSample{value, value - rate * half};
  };
  return leastOfSamples(sample, from, to, options);
}

}  // namespace sdf_ccd::test
