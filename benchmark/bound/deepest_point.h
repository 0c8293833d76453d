#pragma once

#include "precision/exact_surface.h"

namespace sdf_ccd::benchmark {

/// When to stop the search for the deepest point.
struct DepthOptions {
  double inside;     ///< tolerance of depths [m]
  double outside;    ///< the same if the path stays outside, where many points are almost as near
  double max_depth;  ///< the search stops once a point is deeper than this [m]
};

struct DeepestPoint {
  double depth;      ///< [m], positive inside
  double tolerance;  ///< no point is deeper by more [m]
};

/// Depth of the deepest point of a segment, by branch and bound.
///
/// Two bounds hold between two points. The depth changes by no more than the distance along the segment. It does not
/// exceed the distance to either point's nearest triangle, which is convex along the segment, so below its chord.
/// Pieces that cannot hold a deeper point are discarded.
DeepestPoint deepestOn(const precision::ExactSurface& mesh, const Segment& segment, const DepthOptions& options);

}  // namespace sdf_ccd::benchmark
