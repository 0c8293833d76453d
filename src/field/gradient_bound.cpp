#include "gradient_bound.h"

#include <cmath>
#include <cstdint>

#include "../geometry/double_lanes.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

/// Ways between corners of a unit cube: −1, 0 or 1 along each axis; the last one only fills the vectors.
constexpr int kWays = 28;

/// Of the way from corner a to corner b.
struct WayIndex {
  std::array<std::array<std::uint8_t, 8>, 8> at{};

  constexpr WayIndex() {
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b) {
        int index = 13, stride = 1;
        for (int axis = 0; axis < 3; ++axis, stride *= 3) index += stride * ((b >> axis & 1) - (a >> axis & 1));
        at[a][b] = static_cast<std::uint8_t>(index);
      }
  }
};
constexpr WayIndex kWayIndex;

struct Ways {
  alignas(64) std::array<double, kWays> x{}, y{}, z{};

  constexpr Ways() {
    for (int i = 0; i < 27; ++i) {
      x[i] = i % 3 - 1;
      y[i] = i / 3 % 3 - 1;
      z[i] = i / 9 - 1;
    }
  }
};
constexpr Ways kUnitWays;

/// The least that the distance grows by on each way.
SDF_CCD_LANES void leastGrowth(const NearTriangles& near, double* least) {
  const double sine = near.gradientCone().sine;
  if (!(sine < 1.0)) {
    for (int i = 0; i < kWays; ++i) least[i] = -Vector3d(kUnitWays.x[i], kUnitWays.y[i], kUnitWays.z[i]).norm();
    return;
  }
  const double most_weight = (1.0 + 1e-9) / std::sqrt(1.0 - sine * sine);
  const Vector3d& first = near.surface().face(near.triangle(0)).normal;
  for (int i = 0; i < kWays; i += kWidth) {
    const Doubles x = load(kUnitWays.x.data() + i), y = load(kUnitWays.y.data() + i), z = load(kUnitWays.z.data() + i);
    Doubles growth = x * first[0] + y * first[1] + z * first[2];
    for (std::size_t j = 1; j < near.size(); ++j) {
      const Vector3d& n = near.surface().face(near.triangle(j)).normal;
      growth = smaller(growth, x * n[0] + y * n[1] + z * n[2]);
    }
    store(smaller(growth, most_weight * growth), least + i);
  }
}

/// A line per pair of corners, over the weight of the second: its value and its slope.
struct Lines {
  Doubles value, slope;
};

/// The highest of the lines of all eight corners, at each pair's weight.
SDF_CCD_INLINE Lines highest(const Lines* lines, const Doubles& weight) {
  Lines top = lines[0];
  top.value += weight * top.slope;
  for (int k = 1; k < 8; ++k) {
    const Doubles value = lines[k].value + weight * lines[k].slope;
    top.slope = value > top.value ? lines[k].slope : top.slope;
    top.value = larger(value, top.value);
  }
  return top;
}

/// The least over the weights from 0 to 1 of what is highest there, of the best pair, unless less than `enough` is
/// found before. Between two weights, the next is where their highest lines meet; any weight gives a bound, so that it
/// need not be the best.
SDF_CCD_INLINE double lowestTop(const Lines* lines, double enough) {
  const Doubles zero = {}, one = zero + 1.0;
  Doubles low = zero, high = one;
  Lines at_low = highest(lines, low), at_high = highest(lines, high);
  Doubles best = smaller(at_low.value, at_high.value);
  constexpr int kRounds = 2;
  for (int i = 0; i < kRounds && leastOf(best) > enough; ++i) {
    const Doubles bend = at_low.slope - at_high.slope;
    const Doubles meet = (at_high.value - at_low.value + low * at_low.slope - high * at_high.slope) / bend;
    const Doubles weight = ((meet > low) & (meet < high)) ? meet : low;
    const Lines at = highest(lines, weight);
    best = smaller(best, at.value);
    const auto falls = at.slope < zero;
    low = falls ? weight : low;
    at_low = {falls ? at.value : at_low.value, falls ? at.slope : at_low.slope};
    high = falls ? high : weight;
    at_high = {falls ? at_high.value : at.value, falls ? at_high.slope : at.slope};
  }
  return leastOf(best);
}

}  // namespace

GradientBound::GradientBound(const NearTriangles& near) {
  alignas(64) double least[kWays];
  leastGrowth(near, least);
  for (int k = 0; k < 8; ++k)
    for (int pair = 0; pair < kPairs; ++pair) {
      least_.from_low[k][pair] = least[kWayIndex.at[pair][k]];
      least_.from_high[k][pair] = least[kWayIndex.at[7 - pair][k]];
      most_.from_low[k][pair] = -least[kWayIndex.at[k][pair]];
      most_.from_high[k][pair] = -least[kWayIndex.at[k][7 - pair]];
    }
}

/// How far the interpolant is above φ (sign 1) or below it (−1), at most.
SDF_CCD_LANES double GradientBound::above(const Table& growth, double side, const Corners& exact, const Corners& values,
                                          double sign, double enough) {
  const Doubles low = sign * load(exact.data());
  const Doubles high = {sign * exact[7], sign * exact[6], sign * exact[5], sign * exact[4]};
  Lines lines[8];
  for (int k = 0; k < 8; ++k) {
    const double at = sign * values[k], step = sign * side;
    const Doubles first = at - (low + step * load(growth.from_low[k].data()));
    const Doubles second = at - (high + step * load(growth.from_high[k].data()));
    lines[k] = {first, second - first};
  }
  return lowestTop(lines, enough);
}

Deviation GradientBound::deviation(double side, const Corners& exact, const Corners& values,
                                   const Deviation& enough) const {
  return {above(least_, side, exact, values, 1.0, enough.above), above(most_, side, exact, values, -1.0, enough.below)};
}

}  // namespace sdf_ccd
