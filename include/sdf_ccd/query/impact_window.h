#pragma once

#include <optional>

#include "sdf_ccd/query/segment_query.h"

namespace sdf_ccd {

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
