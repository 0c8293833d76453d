#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

#include "sdf_ccd/monitor/pair_distances.h"

namespace sdf_ccd {

/// What a pair of a scene can do, and how near it may come. The default is the one that limits most.
struct PairTraits {
  bool is_own = false;       ///< both bodies are links of the robot, or what these hold
  bool is_constant = false;  ///< their distance cannot change, whatever the joints do
  double max_closing =
      std::numeric_limits<double>::infinity();  ///< speed at which it can close with all joints at their limits [m/s]
  std::optional<double> stop_distance = {};     ///< [m]; none: that of all pairs
};

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
