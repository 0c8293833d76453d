#include "gradient_bound.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/compiler_lanes.h"

namespace sdf_ccd {
namespace {

using namespace lanes;

/// Directions between corners of a unit cube: −1, 0 or 1 along each axis; the last one only fills the vectors.
constexpr int kDirections = 28;

/// Index of the direction from corner a to corner b.
struct DirectionIndex {
  std::array<std::array<std::uint8_t, 8>, 8> at{};

  constexpr DirectionIndex() {
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b) {
        int index = 13, stride = 1;
        for (int axis = 0; axis < 3; ++axis, stride *= 3) index += stride * ((b >> axis & 1) - (a >> axis & 1));
        at[a][b] = static_cast<std::uint8_t>(index);
      }
  }
};
constexpr DirectionIndex kDirectionIndex;

struct Directions {
  alignas(64) std::array<double, kDirections> x{}, y{}, z{};

  constexpr Directions() {
    for (int i = 0; i < 27; ++i) {
      x[i] = i % 3 - 1;
      y[i] = i / 3 % 3 - 1;
      z[i] = static_cast<double>(i / 9 - 1);
    }
  }
};
constexpr Directions kUnitDirections;

/// Lower bound of the distance's growth along each direction.
SDF_CCD_LANES void leastGrowth(const NearTriangles& near, double* least) {
  const double sine = near.gradientCone().sine;
  if (!(sine < 1.0)) {
    for (int i = 0; i < kDirections; ++i)
      least[i] = -Vector3d(kUnitDirections.x[i], kUnitDirections.y[i], kUnitDirections.z[i]).norm();
    return;
  }
  const double max_weight = (1.0 + 1e-9) / std::sqrt(1.0 - sine * sine);
  const Vector3d& first = near.surface().face(near.triangle(0)).normal;
  for (int i = 0; i < kDirections; i += kWidth) {
    const Doubles x = load(kUnitDirections.x.data() + i), y = load(kUnitDirections.y.data() + i),
                  z = load(kUnitDirections.z.data() + i);
    Doubles growth = x * first[0] + y * first[1] + z * first[2];
    for (std::size_t j = 1; j < near.size(); ++j) {
      const Vector3d& n = near.surface().face(near.triangle(j)).normal;
      growth = smaller(growth, x * n[0] + y * n[1] + z * n[2]);
    }
    store(smaller(growth, max_weight * growth), least + i);
  }
}

/// Pairs of diagonally opposite corners. Floats has two lanes for each: the first four lanes bound how far an
/// interpolant is above φ, the last four how far it is below.
constexpr int kPairs = 4;
static_assert(2 * kPairs == kFloatWidth, "one vector");
constexpr Floats kSign = {1.0F, 1.0F, 1.0F, 1.0F, -1.0F, -1.0F, -1.0F, -1.0F};

/// The bounds by the best pair, above and below φ.
struct Least {
  float above, below;
};
SDF_CCD_INLINE Least leastOf(const Floats& v) {
  return {std::min(std::min(v[0], v[1]), std::min(v[2], v[3])), std::min(std::min(v[4], v[5]), std::min(v[6], v[7]))};
}

/// A linear function of the weight of the pair's second corner, per lane: its value at a weight, and its slope.
struct Lines {
  Floats value, slope;
};

/// Per lane, the line of the eight corners' lines that has the largest value at the lane's weight.
SDF_CCD_INLINE Lines highest(const Lines* lines, const Floats& weight) {
  Lines top = lines[0];
  top.value += weight * top.slope;
  for (int k = 1; k < 8; ++k) {
    const Floats value = lines[k].value + weight * lines[k].slope;
    top.slope = value > top.value ? lines[k].slope : top.slope;
    top.value = larger(value, top.value);
  }
  return top;
}

/// The minimum of highest() over the weights from 0 to 1, for the best pair; stops early when both values are at most
/// `enough`. The next weight between two is where their highest lines intersect. Any weight gives a valid bound, so the
/// minimum need not be exact.
SDF_CCD_INLINE Least lowestTop(const Lines* lines, const Least& enough) {
  const Floats zero = {}, one = zero + 1.0F;
  Floats low = zero, high = one;
  Lines at_low = highest(lines, low), at_high = highest(lines, high);
  Floats best = smaller(at_low.value, at_high.value);
  Least found = leastOf(best);
  constexpr int kRounds = 2;
  for (int i = 0; i < kRounds && (found.above > enough.above || found.below > enough.below); ++i) {
    const Floats bend = at_low.slope - at_high.slope;
    const Floats meet = (at_high.value - at_low.value + low * at_low.slope - high * at_high.slope) / bend;
    const Floats weight = ((meet > low) & (meet < high)) ? meet : low;
    const Lines at = highest(lines, weight);
    best = smaller(best, at.value);
    found = leastOf(best);
    const auto falls = at.slope < zero;
    low = falls ? weight : low;
    at_low = {falls ? at.value : at_low.value, falls ? at.slope : at_low.slope};
    high = falls ? high : weight;
    at_high = {falls ? at_high.value : at.value, falls ? at_high.slope : at.slope};
  }
  return found;
}

}  // namespace

GradientBound::GradientBound(const NearTriangles& near) {
  alignas(64) double least[kDirections];
  leastGrowth(near, least);
  float rounded[kDirections];
  for (int i = 0; i < kDirections; ++i) rounded[i] = static_cast<float>(least[i]);
  const auto growth = [&](int from, int to) { return rounded[kDirectionIndex.at[from][to]]; };
  for (int k = 0; k < 8; ++k)
    for (int pair = 0; pair < kPairs; ++pair) {
      from_low_[k][pair] = growth(pair, k);
      from_high_[k][pair] = growth(7 - pair, k);
      from_low_[k][kPairs + pair] = growth(k, pair);
      from_high_[k][kPairs + pair] = growth(k, 7 - pair);
    }
  for (const double by : least) max_growth_ = std::max(max_growth_, std::abs(by));
}

SDF_CCD_LANES Deviation GradientBound::deviation(double side, const CornerValues& exact, const CornerValues& values,
                                                 const Deviation& enough) const {
  // In units of the cube's side and relative to one of the corners, so that single precision rounds little.
  const double per_side = 1.0 / side;
  float e[8], at[8];
  double largest = max_growth_;
  for (int k = 0; k < 8; ++k) {
    const double phi = (exact[k] - exact[0]) * per_side, value = (values[k] - exact[0]) * per_side;
    largest = std::max({largest, std::abs(phi), std::abs(value)});
    e[k] = static_cast<float>(phi);
    at[k] = static_cast<float>(value);
  }
  const Floats low = kSign * Floats{e[0], e[1], e[2], e[3], e[0], e[1], e[2], e[3]};
  const Floats high = kSign * Floats{e[7], e[6], e[5], e[4], e[7], e[6], e[5], e[4]};
  Lines lines[8];
  for (int k = 0; k < 8; ++k) {
    const Floats value = kSign * at[k];
    const Floats first = value - low - load(from_low_[k].data());
    const Floats second = value - high - load(from_high_[k].data());
    lines[k] = {first, second - first};
  }
  const auto scaled = [&](double bound) { return static_cast<float>(bound * per_side); };
  const Least found = lowestTop(lines, {scaled(enough.above), scaled(enough.below)});
  // A bound takes eight roundings, each by 2^-24 of at most six times the largest number: less than 2^-18 in total.
  constexpr double kRounding = 0x1p-18;
  return {side * (found.above + kRounding * largest), side * (found.below + kRounding * largest)};
}

}  // namespace sdf_ccd
