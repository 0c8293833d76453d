#pragma once

#include <cstdint>
#include <vector>

#include "flat_pieces.h"
#include "point_grid.h"
#include "sample_surface.h"
#include "sampled_points.h"
#include "sdf_ccd/common/cancel.h"
#include "sdf_ccd/geometry/triangle_mesh.h"
#include "surface_piece.h"

namespace sdf_ccd {

/// Adds points to a shell until no location of the mesh is farther than options.spacing from a point whose normal does
/// not oppose the location's, or throws Cancelled on request.
class SurfaceFiller {
 public:
  /// @param mesh  welded.
  SurfaceFiller(const TriangleMesh& mesh, const ShellOptions& options);

  /// The mesh's vertices, thinned to options.vertex_spacing.
  void addVertices();
  /// Points along edges, until no location of one is farther than `radius` from a point [m].
  void fillEdges(const std::vector<SurfaceEdge>& edges, double radius);
  /// Poisson-disk sampling: random locations, kept if no point with a compatible normal is nearer than the spacing.
  void throwDarts();
  /// Halves triangles until one point covers each piece; adds a point wherever none does.
  void fillGaps();

  SampledPoints take() { return std::move(shell_); }

 private:
  [[noreturn]] void refuse() const;
  void add(const Vector3d& p, const Vector3d& normal);
  bool isCovered(const Vector3d& p, const Vector3d& normal) const;
  void fillGaps(const SurfacePiece& whole, const Vector3d& normal);

  const CancelPoint cancel_;
  const TriangleMesh& mesh_;
  const ShellOptions& options_;
  std::vector<Vector3d> triangle_normals_;  // unit, or zero
  PointGrid grid_;
  SampledPoints shell_;
  std::vector<SurfacePiece> pieces_;  // the current triangle's pieces that are still to be filled
};

}  // namespace sdf_ccd
