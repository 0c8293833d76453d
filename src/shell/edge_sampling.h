#pragma once

#include "sample_surface.h"
#include "sampled_points.h"

namespace sdf_ccd {

/// How edges are sampled so that two surfaces' contact gap is options.edge_gap: one edge radius and four times the
/// flatness (see contact_gap.h). Flat pieces of a curved surface are √(8 r flatness) wide, so there a flatness of an
/// eighth of the radius needs the fewest points; for flat faces a flatness of zero does. These values lie between both.
struct EdgeSampling {
  double radius;    ///< [m]
  double flatness;  ///< [m]
  /// Spacing on a surface that needs fewer points all over it than on its edges; leaves room for the flatness of the
  /// body's other surfaces [m].
  double covering;

  explicit EdgeSampling(const ShellOptions& options)
      : radius(0.8 * options.edge_gap),
        flatness(0.05 * options.edge_gap),
        covering(options.has_siblings ? 0.9 * options.edge_gap : options.edge_gap) {}
};

/// Whether the options request points on edges.
inline bool hasEdges(const ShellOptions& options) {
  return options.edge_gap > 0.0 && options.edge_gap < options.spacing;
}

/// As the public sampleSurface(), but with the given radii for edges, before rounding.
SampledPoints samplePoints(const TriangleMesh& mesh, const ShellOptions& options, const EdgeSampling& edges);

}  // namespace sdf_ccd
