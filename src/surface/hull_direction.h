#pragma once

#include <optional>

#include "surface/box_tree.h"
#include "surface/triangle_pairs.h"

namespace sdf_ccd {

/// The extent of two surfaces along a direction, up to kBoxRounding.
struct ExtentsAlong {
  double end_a;    ///< where A ends, from A's origin [m]
  double begin_b;  ///< where B begins, at either pose, from A's origin [m]

  double gap() const { return begin_b - end_a; }
};

/// @param n_A  a unit vector.
ExtentsAlong extentsAlong(const BoxTree& a, const BoxTree& b, const EndPoses& poses, const Vector3d& n_A);

/// The gap itself, over all corners in double precision.
double gapAlong(const BoxTree& a, const BoxTree& b, const EndPoses& poses, const Vector3d& n_A);

/// A direction along which all of B, at both poses, lies beyond all of A, with about the largest gap: that between the
/// convex hull of A and that of B at both poses (Gilbert, Johnson, Keerthi 1988). It needs a proof: see MovingBoxes.
/// @return frame A; std::nullopt if the hulls meet, or it was not found in a few steps.
std::optional<Vector3d> hullDirection(const BoxTree& a, const BoxTree& b, const EndPoses& poses);

}  // namespace sdf_ccd
