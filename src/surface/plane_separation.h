#pragma once

#include "sdf_ccd/primitive.h"
#include "separation.h"

/// Whether a surface stays above a plane while both move, and how far.
namespace sdf_ccd {

/// The lowest point of a surface over a half-space. Heights count along the plane's normal, and are negative below the
/// plane [m].
struct LowestPoint {
  double height = 0.0;              ///< of `p_F`
  double at_least = 0.0;            ///< lower bound of the height of all points of the surface, up to heightRounding()
  Vector3d p_F = Vector3d::Zero();  ///< [m]
};

/// Upper bound of the rounding errors of heights at either pose [m]; see separation().
double heightRounding(const HalfSpace& half_space, const BoxTree& surface, const EndPoses& poses);

/// @param accuracy  `at_least` is lower than `height` by no more than this [m], or than 10⁻⁶ of the surface's radius if
///                  many triangles are that near to the lowest point.
/// @param witness   as in separation(): where to start.
/// Cost: 0.1 to 0.5 µs for a convex surface, also if many triangles lie flat on the plane.
LowestPoint lowestPoint(const HalfSpace& half_space, const BoxTree& surface, const Isometry3d& X_FP, double accuracy,
                        SeparationWitness& witness, SeparationMemory& memory);

/// Tests the surface P against a half-space, given in frame F, as separation() tests surfaces. The half-space is solid:
/// a surface wholly below the plane crosses it too. SeparationOptions::max_tests counts poses; with none left, only the
/// ends of the motion are tested.
///
/// The proof. Over an interval of length h each point's height is within e = a h²/8 of the line between its heights at
/// both ends. So the surface's lowest height is at least the smaller one of its lowest heights at both ends, less e:
/// kApart if that exceeds the margin. At the ends themselves it is exact: kCrossing if it is below −margin. Otherwise
/// the interval is halved, which divides e by four, until e is a small part of the resolution.
///
/// Why open_within holds, and to both sides: the lowest height in an interval left open is at most margin + e, and at
/// least −margin − e, with the largest of these e. All others are apart. It is never infinite.
Separation planeSeparation(const HalfSpace& half_space, const BoxTree& surface, const TwoBodyMotion& motion,
                           const SeparationOptions& options, SeparationWitness& witness, SeparationMemory& memory);

}  // namespace sdf_ccd
