#pragma once

#include <optional>

#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd {

/// How near to the surface a moving point comes, or how deep inside, as far as a field knows.
struct LeastDistance {
  double time;   ///< in [0, 1], where `value` is
  double value;  ///< of the field, negative inside: the least, or nearly; it may lie beyond the bounds [m]
  double low;    ///< the least true distance along the path is at least low
  double high;   ///< and at most high [m]
};

/// The least distance along a segment. A depth d that is reported for the whole path is wrong by no more than
/// max(d + high, −low − d), wherever on it the path may truly be deepest.
///
/// Errors are those of the places that may be it: of the leaves that an adaptive grid's path crosses, or what samples
/// of a uniform grid say of pieces of the path (see src/field/uniform/sample_bracket.h). Beyond the band they are
/// larger, as those of DistanceField::sample() are.
/// @param segment  as segmentIntervals(); anywhere, also outside the field's box.
/// @throws std::invalid_argument if the segment is not within reach.
/// Cost: half to all of what integrateContact() takes on the same path; at most 128 places, and all leaves on the way.
LeastDistance leastDistance(const DistanceField& field, const Segment& segment);

/// When a moving point first meets the true surface, as far as a field knows; times in [0, 1].
struct ImpactWindow {
  double earliest;               ///< before, the true distance is positive
  std::optional<double> time;    ///< of the interpolated field; within the window
  std::optional<double> latest;  ///< there the true distance is not positive; none if the point may only graze
};

/// The window of a moving point's first contact. The error of a time of impact is that of the distance over the speed
/// at which the point closes in; here both are taken at the place where they count: from ball to ball of what the
/// distance surely is (DistanceField::sample()) up to the surface, and on to a place that is surely inside.
/// @param segment  as segmentIntervals().
/// @return nothing if the true distance is surely positive all along.
std::optional<ImpactWindow> impactWindow(const DistanceField& field, const Segment& segment);

}  // namespace sdf_ccd
