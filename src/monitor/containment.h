#pragma once

#include <optional>

#include "scene/body_triangles.h"
#include "sdf_ccd/body.h"
#include "surface/separation.h"

namespace sdf_ccd {

/// A point of the surface of one of two bodies F and P that is certainly inside the other.
struct InsidePoint {
  bool is_of_p;  ///< of body P
  Vector3d p;    ///< frame of its own body
};

/// Whether one of two bodies has a component wholly inside the other (design §3.15).
struct Containment {
  bool excluded;                      ///< neither has; false also if that is not known
  std::optional<InsidePoint> inside;  ///< of such a component; empty if none is known
};

/// For two bodies with triangles, at a pose at which their surfaces are apart.
/// @param attempt  0: looks from all corners of each component; otherwise from one of them, another in each attempt,
///                 which takes a fraction of the time.
Containment containmentOf(const Body& f, const Body& p, const Isometry3d& X_FP, int attempt);

/// Looks for a point of one body's surface inside the other by more than `margin`, whether their surfaces cross or not.
/// Tests a few points only, in some tens of microseconds. Empty if none is found.
std::optional<InsidePoint> deepPoint(const Body& f, const Body& p, const Isometry3d& X_FP, double margin,
                                     SeparationMemory& memory);

}  // namespace sdf_ccd
