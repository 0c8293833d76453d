#pragma once

#include <algorithm>
#include <vector>

#include "sdf_ccd/distances.h"

namespace sdf_ccd {

/// @param traits  per pair of the scene; empty: the default for all.
inline const PairTraits& traitsOf(const PairDistance& pair, const std::vector<PairTraits>& traits) {
  static const PairTraits none;
  return traits.empty() ? none : traits[static_cast<std::size_t>(pair.pair)];
}

/// Whether the pair is apart, and will stay as it is.
inline bool cannotChange(const PairDistance& pair, const PairTraits& traits) {
  return (pair.is_constant || traits.is_constant) && pair.any.width > 0.0;
}

/// The largest stop distance of all pairs [m]. @param of_others  of pairs without one of their own.
inline double largestStopDistance(const std::vector<PairTraits>& traits, double of_others) {
  double largest = of_others;
  for (const PairTraits& pair : traits) largest = std::max(largest, pair.stop_distance.value_or(of_others));
  return largest;
}

}  // namespace sdf_ccd
