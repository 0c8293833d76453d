#pragma once

#include "sdf_ccd/shell/sample_surface.h"

namespace sdf_ccd {

/// How edges are sampled so that two surfaces' contact gap is options.edge_gap: one edge radius and four times the
/// flatness (see contact_gap.h). Flat pieces of a curved surface are √(8 r flatness) wide, so there a flatness of an
/// eighth of the radius needs the fewest points; flat faces want none. Between the two:
struct EdgeSampling {
  double radius;    ///< [m]
  double flatness;  ///< [m]
  /// Of a surface that needs fewer points on all of it than on its edges; leaves room for siblings' flatness [m].
  double covering;

  explicit EdgeSampling(const ShellOptions& options)
      : radius(0.8 * options.edge_gap),
        flatness(0.05 * options.edge_gap),
        covering(options.has_siblings ? 0.9 * options.edge_gap : options.edge_gap) {}
};

/// Whether points on edges are wanted.
inline bool hasEdges(const ShellOptions& options) {
  return options.edge_gap > 0.0 && options.edge_gap < options.spacing;
}

/// As the public sampleSurface(), with other radii.
PointShell sampleSurface(const TriangleMesh& mesh, const ShellOptions& options, const EdgeSampling& edges);

}  // namespace sdf_ccd
