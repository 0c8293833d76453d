#pragma once

#include "precision/exact_surface.h"

namespace sdf_ccd::benchmark {

/// When to stop looking for the deepest place.
struct DepthSearch {
  double inside;   ///< tolerance of depths [m]
  double outside;  ///< the same where the path stays outside: there places are many
  double most;     ///< once something is deeper how deep does not matter [m]
};

struct DeepestPlace {
  double depth;      ///< [m], positive inside
  double tolerance;  ///< nothing is deeper by more [m]
};

/// How deep a segment gets.
///
/// Between two places depths change by no more than the way, and are no more than the distance from either place's
/// nearest triangle: that is convex along the segment, so it is below its chord. What cannot be deeper is not looked
/// into.
DeepestPlace deepestOn(const precision::ExactSurface& mesh, const Segment& segment, const DepthSearch& search);

}  // namespace sdf_ccd::benchmark
