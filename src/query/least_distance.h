#pragma once

#include <optional>

#include "sdf_ccd/segments.h"

namespace sdf_ccd {

/// The minimal distance from the surface of a moving point, or its maximal depth, within the field's accuracy.
struct LeastDistance {
  double time;   ///< in [0, 1], where `value` is
  double value;  ///< of the field, negative inside: the minimum, or close to it; may be outside the bounds [m]
  double low;    ///< lower bound of the minimal true distance along the path
  double high;   ///< upper bound of it [m]
};

/// The least distance along a segment. A depth d that is reported for the whole path is wrong by no more than
/// max(d + high, −low − d), wherever on the path the true maximum is.
///
/// Only errors at possible minimisers count: of the leaves that the path crosses in an adaptive grid, or what the
/// samples of a uniform grid say about pieces of the path (see src/field/uniform/sample_bracket.h). Beyond the band
/// they are larger, as those of DistanceField::sample() are.
/// @param segment  as segmentIntervals(); anywhere, also outside the field's box.
/// @throws std::invalid_argument if the segment is not within reach.
/// Cost: half to all of what integrateContact() takes on the same path; at most 128 samples, and all leaves on it.
LeastDistance leastDistance(const DistanceField& field, const Segment& segment);

/// When a moving point first touches the true surface, within the field's accuracy; times in [0, 1].
struct ImpactWindow {
  double earliest;               ///< until then, the true distance is positive
  std::optional<double> time;    ///< of the interpolated field; within the window
  std::optional<double> latest;  ///< there the true distance is not positive; none if the point may only graze
};

/// The time of impact of a moving point, as a window. The error of a time of impact is that of the distance over the
/// approach speed; here both are taken locally: from one empty sphere to the next up to the
/// surface (DistanceField::sample()), and on to a point that is surely inside.
/// @param segment  as segmentIntervals().
/// @return nothing if the true distance is surely positive along the whole path.
std::optional<ImpactWindow> impactWindow(const DistanceField& field, const Segment& segment);

}  // namespace sdf_ccd
