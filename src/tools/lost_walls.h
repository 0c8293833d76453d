#pragma once

#include <optional>
#include <string>

#include "field/lost_surface.h"
#include "solid/solid_boundary.h"

namespace sdf_ccd::tools {

/// Looks for walls that a field does not show, at tens of thousands of points of the surface that are spread evenly
/// over its area, at least one on each triangle.
/// @param solid  of which the field was made.
/// @throws Cancelled.
LostSurface findLostSurface(const DistanceField& field, const Solid& solid);

/// Whether so much is lost that it is reported: more than the tips of sharp edges.
bool isNoticed(const LostSurface& lost);

/// A sentence for users about what is lost; empty if it is not noticed.
std::string describeLost(const LostSurface& lost, const DistanceField& field);

}  // namespace sdf_ccd::tools
