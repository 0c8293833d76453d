#pragma once

#include <vector>

#include "mesh/triangle_tree.h"

namespace sdf_ccd {

/// Upper bound of the distance from any point of some triangles to the nearest of others [m]. It exceeds the largest
/// such distance by no more than a tenth of it and the tolerance, or is infinite, if that takes too many queries.
double reachFrom(const TriangleTree& others, const std::vector<Corners>& triangles, double tolerance);

}  // namespace sdf_ccd
