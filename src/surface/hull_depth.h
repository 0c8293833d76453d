#pragma once

#include <array>

#include "part_depth.h"

namespace sdf_ccd {

/// One value for each of a triangle's corners at the start of a motion, then at its end.
using HullValues = std::array<double, 6>;

/// The hull of these corners.
struct Hull {
  std::array<Vector3d, 6> corners;
  Vector3d center = Vector3d::Zero();
  double size = 0.0;  ///< no corner is farther from the center [m]
};

/// Upper bounds of the depth in a hull [m].
struct HullDepth {
  double bound = -kInfinity;   ///< of all points
  HullValues at_corners = {};  ///< of the corners alone
};

/// Bounds the depth in one element of a body. The bounds and why they hold: see DeepestSearch.
/// @param hull    in the body's frame.
/// @param sufficient_bound  a smaller bound is not tightened [m].
HullDepth hullDepth(const SolidPart& part, const Hull& hull, double sufficient_bound);

}  // namespace sdf_ccd
