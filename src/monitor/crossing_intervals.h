#pragma once

#include "surface_pair.h"

namespace sdf_ccd {

/// Adds the times at which no point of a shell is inside, but the surfaces cross: edges do so between points. A contact
/// then lasts from cycle to cycle, with or without shell points inside.
///
/// Before the intervals, after them, and in each gap between them, some times are tested in turn from both ends, up to
/// the first at which no crossing is certain. Between two such times at which surfaces cross they are taken to cross.
/// Of more than a hundred gaps some are tested, evenly; those between two that are closed are taken to be closed too.
/// @param intervals     of the contact, disjoint and increasing, not empty [s].
/// @param crossings     receives the crossings that were found, without a depth.
/// @param motion_error  see SurfacePair::decide().
void addCrossings(SurfacePair& surfaces, double motion_error, SeparationMemory& memory,
                  std::vector<Interval>& intervals, std::vector<ContactPoint>& crossings);

}  // namespace sdf_ccd
