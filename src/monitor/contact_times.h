#pragma once

#include <optional>
#include <vector>

#include "pair_depth.h"
#include "surface_pair.h"

namespace sdf_ccd {

/// A time at which a pair was looked at.
struct TimeSample {
  double time;   ///< [s]
  bool touches;  ///< certainly
  /// If known, and it does not touch: they are apart from then until this, up to the next sample at most, and since
  /// this, from the last sample at least [s].
  std::optional<double> apart_until = {}, apart_since = {};
};

/// Sets when two bodies touch during a motion: the intervals of the result, and its first and last touch.
///
/// They are looked at at some times: the start, the end, those at which they are known to touch, and some in each gap
/// between two at which they do. Between a time at which they touch and one at which they are not known to, the begin
/// or the end of the contact is bracketed: they are apart on one side, and certainly touch on the other. An interval
/// holds the times between these brackets and the brackets themselves. Bodies that part and meet again between two
/// times at which they touch are not told.
/// @param surfaces, depth  must have the motion. @param found  of depth.
/// @param crossing  of the surfaces, or a point of one body inside the other, if one is known.
/// @param samples   scratch memory.
void setContactTimes(SurfacePair& surfaces, const PairDepth& depth, const PairDepth::Found& found,
                     const std::optional<ContactPoint>& crossing, SeparationMemory& memory,
                     std::vector<TimeSample>& samples, PairResult& result);

}  // namespace sdf_ccd
